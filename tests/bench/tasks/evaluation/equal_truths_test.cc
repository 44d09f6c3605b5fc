#include "bench/tasks/evaluation/equal_truths.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "io/clips/clip_file.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "sim/choreography/canonical_body.h"

namespace etude {
namespace {

using ::testing::ElementsAre;

/// A sway of the standing body, seen from a camera: turned about the vertical axis, then moved. `seed` chooses the
/// motion. In frame `jump_at`, the first joint is 2 cm higher.
std::string SwayAsCsv(int seed, double turned_rad, double moved_m, int frames = 40, int jump_at = -1) {
  std::string text = "frame,time_s";
  for (const Role role : AllRoles()) {
    for (const char* axis : {"x", "y", "z"}) text += fmt::format(",{}_{}_m", RoleName(role), axis);
  }
  const double c = std::cos(turned_rad), s = std::sin(turned_rad);
  for (int f = 0; f < frames; ++f) {
    text += fmt::format("\n{},{:.6f}", f, f / 30.0);
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const double phase = 0.7 * static_cast<double>(j) + seed, t = f / 30.0;
      const glm::dvec3 p = StandingPose().joints[j] +
                           glm::dvec3(0.05 * std::sin(3 * t + phase), 0.03 * std::cos(2 * t + phase), 0.02 * t * seed);
      text += fmt::format(",{:.4f},{:.4f},{:.4f}", c * p.x + s * p.z + moved_m,
                          p.y + (f == jump_at && j == 0 ? 0.02 : 0), c * p.z - s * p.x + 3);
    }
  }
  return text + "\n";
}

TEST(EqualTruths, CopiesAndCamerasOfOneTakeAreOneUnit) {
  const TemporaryFolder folder = *TemporaryFolder::Make("equal-truths-test");
  std::vector<JudgedFiles> worlds;
  const auto add = [&](const std::string& name, const std::string& text, const std::string& unit = "") {
    const auto file = folder.path() / (name + ".csv");
    ASSERT_TRUE(WriteFileAtomically(file, text));
    worlds.push_back({name, unit, file.string(), {}});
  };
  add("a", SwayAsCsv(1, 0, 0));
  add("a_copy", SwayAsCsv(1, 0, 0));
  add("b", SwayAsCsv(2, 0, 0), "Ann");
  add("a_camera", SwayAsCsv(1, 2.1, 0.4));  // rounded to a tenth of a millimetre after the turn
  add("b_camera", SwayAsCsv(2, -0.5, 1.0), "Bob");
  add("a_shorter", SwayAsCsv(1, 0, 0, 39));
  add("broken", "x");
  add("c", SwayAsCsv(3, 0, 0));
  for (int f = 0; f < 40; ++f) add(fmt::format("d{}", f), SwayAsCsv(1, 0.3, 0, 40, f));
  FindEqualTruths(worlds, OpenOptions{});
  std::vector<std::string> same;
  for (const JudgedFiles& world : worlds) same.push_back(world.same_as);
  for (std::size_t w = 8; w < same.size(); ++w) EXPECT_EQ(same[w], "") << "they differ from a in one frame only";
  same.resize(8);
  EXPECT_THAT(same, ElementsAre("", "a", "", "a", "b", "", "", ""));
  EXPECT_EQ(worlds[4].unit, "Ann") << "the first one's person";
}

}  // namespace
}  // namespace etude
