// The figures of fidelity_test.cc for a crowd, and the order of the presets by these figures.

#include <gtest/gtest.h>

#include "tests/sim/performer/neighbours.h"

namespace etude {
namespace {

TEST(Crowd, HEAVY_IsAsAlikeAndAsDifferentAsRealPeople) {
  const Neighbours crowd = MeasureNeighbours(People::kMixed, 80, 4);
  RecordProperty("found", std::to_string(crowd.found));
  EXPECT_GE(crowd.found, 0.75);
  EXPECT_LE(crowd.found, 0.90);
  EXPECT_GE(crowd.duration_variation, 0.2);
  EXPECT_LE(crowd.duration_variation, 0.35);
}

TEST(Crowd, HEAVY_ToddlersAreHardestToTellAndExpertsEasiest) {
  const auto found = [](People people) { return MeasureNeighbours(people, 40, 3).found; };
  const double toddler = found(People::kToddler), child = found(People::kSchoolChild), adult = found(People::kAdult);
  EXPECT_LT(toddler, child);
  EXPECT_LT(child, adult);
  EXPECT_LT(adult, found(People::kExpert));
}

}  // namespace
}  // namespace etude
