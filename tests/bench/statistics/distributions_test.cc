#include "bench/statistics/distributions.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

TEST(SmallestFinding, AgreesWithTheNoncentralT) {
  // statsmodels: TTestPower().solve_power(nobs=30, alpha=0.05, power=0.8) = 0.5292; 60 pairs, alpha=0.05/12: 0.5005.
  EXPECT_NEAR(SmallestFinding(30, 1), 0.5292, 0.002);
  EXPECT_NEAR(SmallestFinding(60, 12), 0.5005, 0.01);
  EXPECT_GT(SmallestFinding(6, 1), SmallestFinding(7, 1));
}

}  // namespace
}  // namespace etude
