#include "engine/base/smoothstep.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

constexpr double kStep = 1e-4;

/// Returns the first and second derivatives by central differences.
template <typename Function>
double Speed(Function f, double t) {
  return (f(t + kStep) - f(t - kStep)) / (2 * kStep);
}
template <typename Function>
double Acceleration(Function f, double t) {
  return (f(t + kStep) - 2 * f(t) + f(t - kStep)) / (kStep * kStep);
}

TEST(Smoothstep, IsConstantOutsideAndHalfWayInTheMiddle) {
  EXPECT_EQ(Smoothstep(2, 4, 1), 0);
  EXPECT_EQ(Smoothstep(2, 4, 2), 0);
  EXPECT_EQ(Smoothstep(2, 4, 2.5), 3 * 0.0625 - 2 * 0.015625);
  EXPECT_EQ(Smoothstep(2, 4, 3), 0.5);
  EXPECT_EQ(Smoothstep(2, 4, 4), 1);
  EXPECT_EQ(Smoothstep(2, 4, 5), 1);
}

TEST(Smoothstep, StartsAndEndsAtRest) {
  const auto f = [](double t) { return Smoothstep(0, 1, t); };
  EXPECT_NEAR(Speed(f, 0), 0, 1e-3);
  EXPECT_NEAR(Speed(f, 0.5), 1.5, 1e-3);
  EXPECT_NEAR(Speed(f, 1), 0, 1e-3);
  EXPECT_GT(Acceleration(f, 2 * kStep), 5) << "which Smootherstep does not";
}

TEST(Smootherstep, StartsAndEndsWithoutSpeedOrAcceleration) {
  EXPECT_EQ(Smootherstep(-1), 0);
  EXPECT_EQ(Smootherstep(0.5), 0.5);
  EXPECT_EQ(Smootherstep(2), 1);
  EXPECT_NEAR(Speed(Smootherstep, 0.5), 1.875, 1e-3);
  for (const double end : {0.0, 1.0}) {
    EXPECT_NEAR(Speed(Smootherstep, end), 0, 1e-3);
    EXPECT_NEAR(Acceleration(Smootherstep, end), 0, 0.02);
  }
}

}  // namespace
}  // namespace etude
