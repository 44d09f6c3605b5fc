#include "bench/gate/systems.h"

#include <gmock/gmock.h>

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const RunSystem kDebian12{"12.2.0", "2.36", "2.1.0", "4.5 (Core Profile) Mesa 22.3.6, by OSMesa"};
const RunSystem kDebian13{"14.2.0", "2.41", "2.2.0", "4.5 (Core Profile) Mesa 25.0.7-2+deb13u1, by EGL"};

Snapshot ThreeWorlds(std::vector<std::optional<double>> values) {
  Snapshot snapshot;
  snapshot.scenarios.push_back({.name = "s", .trials = 3, .worlds = {}, .methods = {}, .metrics = {}, .cells = {}});
  snapshot.scenarios[0].cells.push_back({"-", "m", "ooo", {{"jump_cm", std::move(values)}}});
  return snapshot;
}

TEST(CompareSystems, SaysNothingOfOneSystem) {
  EXPECT_THAT(CompareSystems(kDebian12, kDebian12, ThreeWorlds({1, 2, 3}), ThreeWorlds({1, 2, 4})), IsEmpty());
}

TEST(CompareSystems, NamesBothAndWhatWasMeasuredBetweenThem) {
  const Snapshot worlds = ThreeWorlds({1, 2, std::nullopt});
  EXPECT_THAT(CompareSystems(kDebian12, kDebian13, worlds, worlds),
              ElementsAre("A: GCC 12.2.0, glibc 2.36, Ceres 2.1.0, Mesa 22.3.6, by OSMesa (Debian 12)",
                          "B: GCC 14.2.0, glibc 2.41, Ceres 2.2.0, Mesa 25.0.7-2+deb13u1, by EGL (Debian 13)",
                          "In a test of these two systems, none of the 2192 cells of the quick suite differed."));
}

TEST(CompareSystems, FindsASystemThatDrewNothingByTheRest) {
  RunSystem other = kDebian13;
  other.renderer = "";
  EXPECT_THAT(CompareSystems(other, kDebian12, {}, {})[0], HasSubstr("Ceres 2.2.0 (Debian 13)"));
}

TEST(CompareSystems, TellsWhatIsMoreThanMeasured) {
  const auto lines = CompareSystems(kDebian12, kDebian13, ThreeWorlds({1, 2, 3}), ThreeWorlds({1, 1.75, 3.125}));
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_EQ(lines[3], "In this comparison, differences are larger than in that test: jump_cm by 0.25.");
}

TEST(CompareSystems, NamesTheLargestMeasuredDifferences) {
  const RunSystem sid{"16.2.0", "2.43", "2.2.0", "4.5 (Core Profile) Mesa 26.2.6-1, by EGL"};
  Snapshot before = ThreeWorlds({30, 31, 32}), within = ThreeWorlds({30, 31.0625, 32});
  Snapshot beyond = ThreeWorlds({30, 31, 32.125});
  for (Snapshot* snapshot : {&before, &within, &beyond}) snapshot->scenarios[0].cells[0].metrics[0].metric = "mpjpe_mm";
  const auto lines = CompareSystems(kDebian13, sid, before, within);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_THAT(lines[2], HasSubstr("at most 80 of the 2192 cells of the quick suite differed ("));
  EXPECT_THAT(lines[2], HasSubstr("mpjpe_mm by 0.064"));
  EXPECT_THAT(CompareSystems(kDebian13, sid, before, beyond).back(),
              HasSubstr("larger than in that test: mpjpe_mm by 0.12"));
}

TEST(CompareSystems, SaysThatNothingIsKnownOfOtherSystems) {
  for (RunSystem other :
       {RunSystem{"15.1.0", "2.41", "2.2.0", ""}, RunSystem{"14.2.0", "2.42", "2.2.0", ""},
        RunSystem{"14.2.0", "2.41", "2.3.0", ""}, RunSystem{"14.2.0", "2.41", "2.2.0", "Mesa 25.1.0"}}) {
    const auto lines = CompareSystems(kDebian12, other, {}, {});
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_THAT(lines[1], HasSubstr("(not measured)"));
    EXPECT_THAT(lines[2], HasSubstr("How much results differ between these two systems has not been measured"));
  }
}

}  // namespace
}  // namespace etude
