#include "bench/metrics/ik_error.h"

#include <gtest/gtest.h>

#include "engine/base/angles.h"

namespace etude {
namespace {

EffectorError Off(double cm, double x_deg, double y_deg, double z_deg) {
  return {cm / 100, {Radians(x_deg), Radians(y_deg), Radians(z_deg)}};
}

TEST(IkError, SolvedMeansEveryEffectorIsNearInBothRespects) {
  const auto summary = [](double cm, double degrees) {
    return SummariseIkErrors(std::vector{Off(0, 0, 0, 0), Off(cm, degrees, degrees, degrees)});
  };
  EXPECT_TRUE(IsSolvedPractically(summary(0.09, 0.09)));
  EXPECT_FALSE(IsSolvedPractically(summary(0.11, 0.0)));
  EXPECT_FALSE(IsSolvedPractically(summary(0.0, 0.11)));
  EXPECT_FALSE(IsSolvedTightly(summary(0.09, 0.09)));
  EXPECT_TRUE(IsSolvedTightly(summary(0.0009, 0.0009)));
  EXPECT_FALSE(IsSolvedTightly(summary(0.0011, 0.0)));
}

TEST(IkError, SolvedMeansEveryAxisNotTheirMean) {
  for (const auto& twisted :
       {Off(0, 0.12, 0.12, 0), Off(0, 0.12, 0, 0.12), Off(0, 0, 0.12, 0.12), Off(0, 0, 0, 0.12)}) {
    const IkErrorSummary errors = SummariseIkErrors(std::vector{Off(0, 0, 0, 0), twisted});
    EXPECT_LT(errors.orientation_max_deg, 0.1) << "the mean would pass";
    EXPECT_FALSE(IsSolvedPractically(errors));
    EXPECT_TRUE(IsSolvedPractically(errors, {.positions = true, .axes = false}));
  }
  EXPECT_FALSE(IsSolvedTightly(SummariseIkErrors(std::vector{Off(0, 0.0012, 0.0012, 0)})));
  EXPECT_TRUE(IsSolvedTightly(SummariseIkErrors(std::vector{Off(0, 0.0009, 0.0009, 0)})));
}

TEST(PenalisedCost, NeverRewardsGivingUp) {
  EXPECT_EQ(PenalisedCost(12, 200, true), 12);
  EXPECT_EQ(PenalisedCost(12, 200, false), 400);
  EXPECT_EQ(PenalisedCost(200, 200, true), 200);
}

}  // namespace
}  // namespace etude
