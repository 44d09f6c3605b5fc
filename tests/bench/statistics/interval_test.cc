#include "bench/statistics/interval.h"

#include <gtest/gtest.h>

#include "sim/random/stream.h"

namespace etude {
namespace {

TEST(Wilson, AgreesWithNewcombesTable) {
  // Newcombe (1998), Statistics in Medicine 17, table I, method 3: 81 of 263, 15 of 148, 0 of 20, 1 of 29.
  EXPECT_NEAR(WilsonInterval(81, 263).low, 0.2553, 5e-5);
  EXPECT_NEAR(WilsonInterval(81, 263).high, 0.3662, 5e-5);
  EXPECT_NEAR(WilsonInterval(15, 148).low, 0.0624, 5e-5);
  EXPECT_NEAR(WilsonInterval(15, 148).high, 0.1605, 5e-5);
  EXPECT_EQ(WilsonInterval(0, 20).low, 0);
  EXPECT_NEAR(WilsonInterval(0, 20).high, 0.1611, 5e-5);
  EXPECT_NEAR(WilsonInterval(1, 29).low, 0.0061, 5e-5);
  EXPECT_NEAR(WilsonInterval(1, 29).high, 0.1718, 5e-5);
  EXPECT_EQ(WilsonInterval(20, 20).high, 1);
}

TEST(PairedShare, IsAdjustedWaldWorkedByHand) {
  // 12 gained and 2 lost of 48: shares 13/50 and 3/50; 0.2 ± 1.95996 √((0.32 − 0.04) / 50).
  const Interval interval = PairedShareInterval(12, 2, 48);
  EXPECT_NEAR(interval.low, 0.2 - 0.14667, 1e-5);
  EXPECT_NEAR(interval.high, 0.2 + 0.14667, 1e-5);
}

TEST(PairedShare, ClaimsNoEqualityFromAFewEqualWorlds) {
  const Interval few = PairedShareInterval(0, 0, 12), many = PairedShareInterval(0, 0, 2000);
  EXPECT_GT(few.high, 0.15);
  EXPECT_LT(many.high, 0.002);
  EXPECT_DOUBLE_EQ(few.low, -few.high);
  EXPECT_GE(PairedShareInterval(6, 0, 6).low, -1);
  EXPECT_LE(PairedShareInterval(6, 0, 6).high, 1);
}

TEST(PairedShare, CoversTheTruthAboutNineteenTimesOfTwenty) {
  int covered = 0;
  for (int i = 0; i < 1000; ++i) {
    RandomStream dice({.suite_seed = 5, .scenario = "coverage", .trial = i}, "x");
    int gained = 0, lost = 0;
    for (int world = 0; world < 60; ++world) {
      const double u = dice.Uniform();
      gained += u < 0.15;
      lost += u > 0.95;
    }
    const Interval interval = PairedShareInterval(gained, lost, 60);
    covered += interval.low <= 0.1 && 0.1 <= interval.high;
  }
  EXPECT_NEAR(covered, 950, 25);
}

}  // namespace
}  // namespace etude
