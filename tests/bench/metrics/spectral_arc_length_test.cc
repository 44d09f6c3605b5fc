#include "bench/metrics/spectral_arc_length.h"

#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace etude
