#include "bench/metrics/measurement.h"

#include <gtest/gtest.h>

#include "bench/metrics/ik_error.h"

namespace etude {
namespace {

const glm::dvec3 kX(1, 0, 0), kY(0, 1, 0);

TEST(MeasuredError, LeavesTheMeanAloneForWhatWasNotMeasuredButNotTheCoverage) {
  const std::vector<MeasuredAndTrue> limbs = {{kX, kY}, {kX, kX}, {{}, kX}, {{}, kY}};
  const MeasuredError error = LimbDirectionErrorDeg(limbs);
  EXPECT_NEAR(*error.mean, 45, 1e-12);
  EXPECT_EQ(*error.coverage, 0.5);
}

TEST(MeasuredError, CountsNothingThatHasNoTruth) {
  const std::vector<MeasuredAndTrue> limbs = {{kX, {}}, {{}, {}}};
  EXPECT_FALSE(LimbDirectionErrorDeg(limbs).mean);
  EXPECT_FALSE(LimbDirectionErrorDeg(limbs).coverage);
  EXPECT_FALSE(TriangulationErrorMm({}).mean);
}

TEST(MeasuredError, IsNullWithACoverageOfNothingWhenNothingWasMeasured) {
  const std::vector<MeasuredAndTrue> ends = {{{}, kX}};
  EXPECT_FALSE(TriangulationErrorMm(ends).mean);
  EXPECT_EQ(*TriangulationErrorMm(ends).coverage, 0);
}

TEST(PenalisedCost, NeverRewardsGivingUp) {
  EXPECT_EQ(PenalisedCost(12, 200, true), 12);
  EXPECT_EQ(PenalisedCost(12, 200, false), 400);
  EXPECT_EQ(PenalisedCost(200, 200, true), 200);
}

}  // namespace
}  // namespace etude
