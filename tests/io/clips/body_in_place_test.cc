#include "io/clips/body_in_place.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "engine/formats/npz.h"
#include "tests/engine/motion/moving_body.h"
#include "tests/io/clips/clip_folder.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

constexpr double kRate_hz = 30;

/// Frames [first, last) of a file.
struct Gap {
  int first, last;
};

class StretchesTest : public ClipFolder {
 protected:
  /// Judges a body that sways for 400 frames and jumps by 0.4 m in frame 220. The left wrist is missing in the gaps.
  FaultsInPlace Judged(const std::vector<Gap>& gaps) {
    BodyMotion motion = Swaying(kRate_hz, 400 / kRate_hz);
    EXPECT_EQ(motion.poses.size(), 400u);
    NumberArray positions{.shape = {400, kRoleCount, 3}, .values = {}};
    std::vector<std::string> names;
    for (const Role role : AllRoles()) names.emplace_back(RoleName(role));
    for (int f = 0; f < 400; ++f) {
      const bool is_lost = std::ranges::any_of(gaps, [f](const Gap& gap) { return gap.first <= f && f < gap.last; });
      for (const Role role : AllRoles()) {
        glm::dvec3 p = motion.poses[static_cast<std::size_t>(f)][role] + glm::dvec3(f < 220 ? 0 : 0.4, 0, 0);
        if (is_lost && role == Role::kLeftWrist) p = glm::dvec3(std::nan(""));
        positions.values.insert(positions.values.end(), {p.x, p.y, p.z});
      }
    }
    const std::string file = Write(
        "a.npz", WriteNpz({{"positions", positions}, {"rate_hz", {.shape = {}, .values = {kRate_hz}}}}, {{"names", names}}));
    const auto body = OpenBodyInPlace(file, {});
    EXPECT_TRUE(body) << ToString(body.error());
    return body ? FindFaultsInPlace(*body) : FaultsInPlace{};
  }

  static std::vector<MotionFault> Of(const FaultsInPlace& judged, FaultKind kind) {
    std::vector<MotionFault> faults = judged.found.faults;
    std::erase_if(faults, [kind](const MotionFault& fault) { return fault.kind != kind; });
    return faults;
  }
};

TEST_F(StretchesTest, AreAllJudgedAndEachGapHasItsOwnLength) {
  const std::vector<Gap> gaps = {{60, 100}, {160, 200}, {260, 300}};
  const FaultsInPlace judged = Judged(gaps);
  const auto found = Of(judged, FaultKind::kGaps);
  ASSERT_EQ(found.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found[i].size, 40 / kRate_hz, 1e-9);
    // From the last frame that shows the wrist to the last one that does not.
    EXPECT_NEAR(found[i].from_s, (gaps[i].first - 1) / kRate_hz, 1e-9) << found[i].text;
    EXPECT_NEAR(found[i].to_s, (gaps[i].last - 1) / kRate_hz, 1e-9) << found[i].text;
    EXPECT_NEAR(judged.not_judged_s[i].first, gaps[i].first / kRate_hz, 1e-9);
    EXPECT_NEAR(judged.not_judged_s[i].second, gaps[i].last / kRate_hz, 1e-9);
  }
  // The jump is in the third stretch, which is not the longest.
  const auto jumps = Of(judged, FaultKind::kJumps);
  ASSERT_EQ(jumps.size(), 1u);
  EXPECT_NEAR(jumps[0].to_s, 220 / kRate_hz, 1e-9);
  EXPECT_NEAR(jumps[0].size, 0.4, 0.02);
  EXPECT_EQ(judged.frames, 280u);
  EXPECT_NEAR(judged.file_s, 399 / kRate_hz, 1e-9);
}

TEST_F(StretchesTest, AreOneWithoutGapsThatLastASecond) {
  for (const std::vector<Gap>& gaps : {std::vector<Gap>{}, std::vector<Gap>{{60, 80}}}) {
    const FaultsInPlace judged = Judged(gaps);
    EXPECT_EQ(judged.frames, 400u);
    EXPECT_TRUE(judged.not_judged_s.empty());
    EXPECT_EQ(Of(judged, FaultKind::kGaps).size(), gaps.size());
    EXPECT_EQ(Of(judged, FaultKind::kJumps).size(), 1u);
  }
}

TEST_F(StretchesTest, OfLessThanEightFramesAreNotJudged) {
  const FaultsInPlace judged = Judged({{0, 40}, {45, 90}, {350, 400}});
  EXPECT_EQ(judged.frames, 260u);
  ASSERT_EQ(judged.not_judged_s.size(), 2u);
  EXPECT_NEAR(judged.not_judged_s[0].first, 0, 1e-9);
  EXPECT_NEAR(judged.not_judged_s[0].second, 90 / kRate_hz, 1e-9);
  EXPECT_NEAR(judged.not_judged_s[1].first, 350 / kRate_hz, 1e-9);
  EXPECT_NEAR(judged.not_judged_s[1].second, 400 / kRate_hz, 1e-9);
  const auto gaps = Of(judged, FaultKind::kGaps);
  ASSERT_EQ(gaps.size(), 3u);
  EXPECT_NEAR(gaps[0].size, 40 / kRate_hz, 1e-9);
  EXPECT_NEAR(gaps[1].size, 45 / kRate_hz, 1e-9);
  EXPECT_NEAR(gaps[2].size, 50 / kRate_hz, 1e-9);
  EXPECT_THAT(gaps[1].text, HasSubstr("joints are not shown for 1.50 s"));
}

}  // namespace
}  // namespace etude
