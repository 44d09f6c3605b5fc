#include "io/drawing/panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "io/drawing/marks.h"

namespace etude {
namespace {

TEST(Axis, PutsItsEndsWhereTheyBelongAndTheMiddleBetween) {
  const Axis axis{.low = 10, .high = 20, .from = 200, .to = 0};
  EXPECT_DOUBLE_EQ(axis.At(10), 200);
  EXPECT_DOUBLE_EQ(axis.At(20), 0);
  EXPECT_DOUBLE_EQ(axis.At(15), 100);
  EXPECT_DOUBLE_EQ(axis.At(99), 0);
}

TEST(Axis, OfDecadesIsLogarithmicAndHoldsZeroOnItsEnd) {
  Axis axis = AxisOf({0, 0.02, 5}, 0.001);
  axis.to = 4;
  EXPECT_TRUE(axis.is_logarithmic);
  EXPECT_DOUBLE_EQ(axis.low, 0.001);
  EXPECT_DOUBLE_EQ(axis.high, 10);
  EXPECT_EQ(axis.At(0), axis.from);
  EXPECT_NEAR(axis.At(0.1), axis.from + (axis.to - axis.from) / 2, 1e-9);
  EXPECT_FALSE(AxisOf({0, 0.02, 5}, 0).is_logarithmic) << "shares and differences never are";
  EXPECT_FALSE(AxisOf({1, 5}, 0.001).is_logarithmic);
  EXPECT_FALSE(AxisOf({-1, 5000}, 0.001).is_logarithmic);
}

TEST(Axis, NamesTheEndWhereSmallerValuesAreDrawn) {
  EXPECT_FALSE(AxisOf({0, 1, 4}, 0.001).is_logarithmic) << "zero is no decade";
  const Axis zeros = AxisOf({0, 1, 150}, 0.001);
  EXPECT_TRUE(zeros.is_logarithmic);
  EXPECT_LT(zeros.At(0), zeros.At(1));
  EXPECT_EQ(zeros.TickText(zeros.Ticks().front()), "0");
  EXPECT_EQ(zeros.TickText(zeros.Ticks().back()), "1k");
  const Axis tiny = AxisOf({0, 1e-9, 5}, 0.001);
  EXPECT_EQ(tiny.At(1e-9), tiny.At(0));
  EXPECT_EQ(tiny.TickText(tiny.Ticks().front()), "≤1e-3");
  const Axis plain = AxisOf({0.02, 5}, 0.001);
  EXPECT_EQ(plain.TickText(plain.Ticks().front()), "0.01") << "nothing is smaller";
}

TEST(Axis, HasAFewRoundTicksWithinItself) {
  for (const std::vector<double>& values :
       {std::vector<double>{0, 1}, {41.7, 66.2}, {-53, 1}, {7, 7}, {0, 0}, {1e-4, 3e-4}}) {
    const Axis axis = AxisOf(values, 0);
    const std::vector<double> ticks = axis.Ticks();
    EXPECT_GE(ticks.size(), 2u);
    EXPECT_LE(ticks.size(), 8u);
    for (const double tick : ticks) EXPECT_TRUE(tick >= axis.low && tick <= axis.high) << tick;
    for (const double value : values) EXPECT_TRUE(value > axis.low && value < axis.high) << value;
  }
  EXPECT_EQ(TickText(-3), "−3");
  EXPECT_EQ(TickText(1e-5), "1e-05");
}

TEST(Axis, OfDifferencesAlwaysHoldsZero) {
  EXPECT_LT(AxisAroundZero({3, 5}).low, 0);
  EXPECT_GT(AxisAroundZero({-3, -5}).high, 0);
}

TEST(Swarm, MovesNeighboursAsideWithinItsBounds) {
  EXPECT_THAT(SwarmOffsets({10, 200}, 20), ::testing::Each(0));
  const auto offsets = SwarmOffsets(std::vector<double>(100, 50.0), 20);
  for (const double offset : offsets) EXPECT_LE(std::abs(offset), 20);
  std::vector<double> sorted = offsets;
  std::ranges::sort(sorted);
  EXPECT_EQ(std::ranges::adjacent_find(sorted), sorted.end()) << "no two on the same place";
}

TEST(Swarm, IsThinnedByAFixedStride) {
  EXPECT_EQ(StrideFor(400, 400), 1u);
  EXPECT_EQ(StrideFor(401, 400), 2u);
  EXPECT_EQ(StrideFor(0, 400), 1u);
}

}  // namespace
}  // namespace etude
