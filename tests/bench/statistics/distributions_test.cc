#include "bench/statistics/distributions.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

TEST(MinDetectableDifference, AgreesWithTheNoncentralT) {
  // statsmodels: TTestPower().solve_power(nobs=30, alpha=0.05, power=0.8) = 0.5292; 60 pairs, alpha=0.05/12: 0.5005.
  EXPECT_NEAR(MinDetectableDifference(30, 1), 0.5292, 0.002);
  EXPECT_NEAR(MinDetectableDifference(60, 12), 0.5005, 0.01);
  EXPECT_GT(MinDetectableDifference(6, 1), MinDetectableDifference(7, 1));
}

}  // namespace
}  // namespace etude
