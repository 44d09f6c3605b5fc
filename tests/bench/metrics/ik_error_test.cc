#include "bench/metrics/ik_error.h"

#include <gtest/gtest.h>

#include "engine/base/angles.h"

namespace etude {
namespace {

EffectorError Off(double cm, double x_deg, double y_deg, double z_deg) {
  return {cm / 100, {Radians(x_deg), Radians(y_deg), Radians(z_deg)}};
}

TEST(IkError, TakesMeansOverAxesThenMeansAndWorstOverEffectors) {
  // The published test vector of position_error_* and orientation_error_*.
  const std::vector<EffectorError> errors = {Off(1, 3, 6, 9), Off(2, 0, 0, 0), Off(6, 30, 0, 0), Off(3, 1, 1, 1)};
  const IkErrorSummary summary = SummariseIkErrors(errors);
  EXPECT_NEAR(summary.position_cm, 3, 1e-12);
  EXPECT_NEAR(summary.position_max_cm, 6, 1e-12);
  EXPECT_NEAR(summary.orientation_deg, (6 + 0 + 10 + 1) / 4.0, 1e-12);
  EXPECT_NEAR(summary.orientation_max_deg, 10, 1e-12);
  EXPECT_NEAR(summary.axis_max_deg, 30, 1e-12);
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

TEST(IkError, HiddenAnglesDifferByTheirRootMeanSquare) {
  const std::vector<double> angles = {Radians(3), Radians(-4), 0, 0}, others = {0, 0, 0, 0};
  EXPECT_NEAR(HiddenAngleDifferenceDeg(angles, others), 2.5, 1e-12);
  EXPECT_EQ(HiddenAngleDifferenceDeg(angles, angles), 0);
}

TEST(IkError, HiddenAnglesCountModuloAFullTurn) {
  EXPECT_NEAR(HiddenAngleDifferenceDeg(std::vector{Radians(179)}, std::vector{Radians(-179)}), 2, 1e-9);
}

}  // namespace
}  // namespace etude
