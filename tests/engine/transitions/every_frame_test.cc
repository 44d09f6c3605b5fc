#include <gtest/gtest.h>

#include "tests/engine/transitions/connection.h"

namespace etude {
namespace {

TEST(InBetween, HEAVY_LeadsFromEveryFrameOfEveryClipIntoEveryOtherClipInBoundedTime) {
  const MotionLibrary library = BuiltinLibrary();
  const double bound = 1 + LongestInBetween(library.in_betweens.tween, kJudgedRateHz);
  const Connections connections = TryAll(library, 1);
  EXPECT_EQ(connections.found, connections.tried);
  EXPECT_GT(connections.tried, 50'000);
  EXPECT_LE(connections.worst_wait_s, bound);
}

TEST(InBetween, HEAVY_LeadsEverywhereUnderAnyThreshold) {
  const MotionLibrary library = BuiltinLibrary();
  const double bound = 1 + LongestInBetween(library.in_betweens.tween, kJudgedRateHz);
  for (double threshold : {0.0, 0.1, 6.0}) {
    MatchRules rules;
    rules.threshold = threshold;
    const Connections connections = TryAll(library, 20, rules);
    EXPECT_EQ(connections.found, connections.tried) << threshold;
    EXPECT_LE(connections.worst_wait_s, bound) << threshold;
    EXPECT_EQ(connections.forced == connections.tried, threshold == 0) << "nothing is below 0";
  }
}

}  // namespace
}  // namespace etude
