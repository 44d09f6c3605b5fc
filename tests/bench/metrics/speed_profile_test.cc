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

// Closed form: for the speed sin²(πt/T) the squared jerk is (2π²/T²)² cos²(2πt/T); its integral times T³ is 2π⁴.
TEST(LogDimensionlessJerk, GivesTheClosedFormOfOneSineStroke) {
  std::vector<double> speed;
  constexpr int kSamples = 4000;
  for (int i = 0; i < kSamples; ++i) speed.push_back(std::pow(std::sin(kPi * i / kSamples), 2));
  EXPECT_NEAR(*LogDimensionlessJerk(speed), -std::log(2 * std::pow(kPi, 4)), 0.002);
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
