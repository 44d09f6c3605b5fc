#include "bench/metrics/speed_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/base/angles.h"

namespace etude {
namespace {

std::vector<double> Bell() {
  std::vector<double> speed;
  for (int i = -100; i < 100; ++i) speed.push_back(std::exp(-5 * (i / 100.0) * (i / 100.0)));
  return speed;
}

TEST(SpectralArcLength, GivesThePublishedValueOfABellShapedSpeed) {
  ASSERT_TRUE(SpectralArcLength(Bell(), 100));
  EXPECT_NEAR(*SpectralArcLength(Bell(), 100), -1.41403, 5e-6);
}

TEST(SpectralArcLength, DoesNotDependOnTheSpeedsUnit) {
  std::vector<double> speed = Bell();
  for (double& v : speed) v *= 37;
  EXPECT_NEAR(*SpectralArcLength(speed, 100), *SpectralArcLength(Bell(), 100), 1e-12);
}

TEST(SpectralArcLength, IsWorseForAMotionThatStopsTwice) {
  std::vector<double> jerky = Bell();
  for (std::size_t i = 0; i < jerky.size(); ++i) jerky[i] *= 0.5 + 0.5 * std::cos(0.2 * static_cast<double>(i));
  EXPECT_LT(*SpectralArcLength(jerky, 100), *SpectralArcLength(Bell(), 100) - 0.3);
}

TEST(SpectralArcLength, IsMissingWhereNothingMoves) {
  EXPECT_FALSE(SpectralArcLength(std::vector<double>(50, 0.0), 30));
  EXPECT_FALSE(SpectralArcLength(std::vector<double>{1.0}, 30));
}

TEST(MeanJointSpeed, AveragesTheJoints) {
  BodyMotion motion{30, std::vector<BodyPose>(4)};
  for (int f = 0; f < 4; ++f) motion.poses[f][Role::kHead].x = 0.1 * f;
  const std::vector<double> speed = MeanJointSpeed(motion, -5, 50);
  ASSERT_EQ(speed.size(), 3u);
  EXPECT_NEAR(speed[1], 0.1 * 30 / kRoleCount, 1e-12);
}

/// exp(−5 t²) over t = −1 … 1, `samples` of them.
std::vector<double> Bell(int samples) {
  std::vector<double> speed;
  for (int i = 0; i < samples; ++i) {
    const double t = -1 + 2.0 * i / samples;
    speed.push_back(std::exp(-5 * t * t));
  }
  return speed;
}

TEST(LogDimensionlessJerk, GivesThePublishedValueOfABellShapedSpeed) {
  ASSERT_TRUE(LogDimensionlessJerk(Bell(200)));
  EXPECT_NEAR(*LogDimensionlessJerk(Bell(200)), -5.81636, 5e-6);
}

TEST(LogDimensionlessJerk, DependsNeitherOnTheSpeedsUnitNorMuchOnHowOftenItIsSampled) {
  std::vector<double> speed = Bell(200);
  for (double& v : speed) v *= 37;
  EXPECT_NEAR(*LogDimensionlessJerk(speed), *LogDimensionlessJerk(Bell(200)), 1e-12);
  EXPECT_NEAR(*LogDimensionlessJerk(Bell(800)), *LogDimensionlessJerk(Bell(200)), 0.01);
}

// Closed form: of the speed sin²(πt/T), the jerk squared is (2π²/T²)² cos²(2πt/T), whose integral times T³ is 2π⁴.
TEST(LogDimensionlessJerk, GivesTheClosedFormOfOneSineStroke) {
  std::vector<double> speed;
  constexpr int kSamples = 4000;
  for (int i = 0; i < kSamples; ++i) speed.push_back(std::pow(std::sin(kPi * i / kSamples), 2));
  EXPECT_NEAR(*LogDimensionlessJerk(speed), -std::log(2 * std::pow(kPi, 4)), 0.002);
}

TEST(LogDimensionlessJerk, IsLessForAMotionThatStopsTwice) {
  std::vector<double> jerky = Bell(200);
  for (std::size_t i = 0; i < jerky.size(); ++i) jerky[i] *= 0.5 + 0.5 * std::cos(0.2 * static_cast<double>(i));
  EXPECT_LT(*LogDimensionlessJerk(jerky), *LogDimensionlessJerk(Bell(200)) - 1);
}

TEST(LogDimensionlessJerk, IsMissingWhereNothingMovesOrNothingChangesUnevenly) {
  EXPECT_FALSE(LogDimensionlessJerk(std::vector<double>(50, 0.0)));
  EXPECT_FALSE(LogDimensionlessJerk(std::vector<double>(50, 1.5)));
  EXPECT_FALSE(LogDimensionlessJerk(std::vector<double>{1, 2, 3, 4}));
  EXPECT_FALSE(LogDimensionlessJerk(std::vector<double>{1, 5}));
  EXPECT_FALSE(LogDimensionlessJerk({}));
}

}  // namespace
}  // namespace etude
