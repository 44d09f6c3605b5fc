#include "io/clips/raw_motions.h"

#include <gmock/gmock.h>

#include "engine/formats/trc.h"
#include "engine/motion/clip.h"
#include "sim/choreography/canonical_body.h"
#include "tests/io/clips/clip_folder.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class RawMotionsTest : public ClipFolder {
 protected:
  static RawMotion Opened(const std::string& reference) {
    auto raw = OpenRawMotion(reference, {});
    EXPECT_TRUE(raw) << ToString(raw.error());
    return raw ? *raw : RawMotion{};
  }
};

/// A body that stands 0.3 m above the floor of its file for some frames.
BodyMotion Lifted(double rate_hz, std::size_t frames) {
  BodyMotion motion{rate_hz, std::vector<BodyPose>(frames, StandingPose())};
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint.y += 0.3;
  }
  return motion;
}

TEST_F(RawMotionsTest, MarkersKeepTheirRateTheirFloorAndTheirGaps) {
  MarkerMotion markers{.rate_hz = 50, .names = {}, .frames = {}};
  for (const Role role : AllRoles()) markers.names.emplace_back(RoleName(role));
  for (const BodyPose& pose : Lifted(50, 5).poses) markers.frames.emplace_back(pose.joints.begin(), pose.joints.end());
  markers.frames[2][Index(Role::kLeftHand)].reset();
  const RawMotion raw = Opened(Write("a.trc", WriteTrc(markers, "a")));
  EXPECT_EQ(raw.rate_hz, 50);
  ASSERT_EQ(raw.FrameCount(), 5u);
  const auto at = [&](std::size_t frame, Role role) { return raw.At(frame, raw.roles[Index(role)]); };
  EXPECT_FALSE(IsSeen(at(2, Role::kLeftHand)));
  EXPECT_NEAR(glm::distance(at(2, Role::kLeftFoot), Lifted(50, 1).poses[0][Role::kLeftFoot]), 0, 1e-5);
}

TEST_F(RawMotionsTest, JointsPlacedByRulePlayNoRole) {
  MarkerMotion markers{.rate_hz = 30, .names = {}, .frames = {std::vector<std::optional<glm::dvec3>>()}};
  const BodyPose pose = StandingPose();
  for (const Role role : AllRoles()) {
    if (role == Role::kLeftHand || role == Role::kHipCentre) continue;
    markers.names.emplace_back(RoleName(role));
    markers.frames[0].emplace_back(pose[role]);
  }
  const RawMotion raw = Opened(Write("a.trc", WriteTrc(markers, "a")));
  EXPECT_EQ(raw.roles[Index(Role::kLeftHand)], -1);
  const glm::dvec3 middle = 0.5 * (pose[Role::kLeftHip] + pose[Role::kRightHip]);
  EXPECT_NEAR(glm::distance(raw.At(0, raw.roles[Index(Role::kHipCentre)]), middle), 0, 1e-5);
}

TEST_F(RawMotionsTest, ABuiltInClipIsItsOwnBody) {
  const RawMotion raw = Opened("builtin:clap");
  for (const Role role : AllRoles()) EXPECT_EQ(raw.joints[raw.roles[Index(role)]], RoleName(role));
  EXPECT_TRUE(raw.rotations.empty());
  EXPECT_TRUE(raw.notes.empty());
}

TEST_F(RawMotionsTest, AFileWithoutABodyIsRefused) {
  const auto raw = OpenRawMotion(Write("a.bvh", kTwoJoints), {});
  ASSERT_FALSE(raw);
  EXPECT_THAT(ToString(raw.error()), HasSubstr("a.bvh"));
}

TEST_F(RawMotionsTest, ADigestTellsAChangedFile) {
  const std::string path = Write("a.bvh", kTwoJoints);
  const auto before = DigestOfFile(path, {});
  Write("a.bvh", std::string(kTwoJoints) + "\n");
  ASSERT_TRUE(before);
  EXPECT_NE(*before, *DigestOfFile(path, {}));
  EXPECT_FALSE(DigestOfFile(In("none.bvh"), {}));
  EXPECT_NE(*DigestOfFile("builtin:clap", {}), *DigestOfFile("builtin:sway", {}));
}

}  // namespace
}  // namespace etude
