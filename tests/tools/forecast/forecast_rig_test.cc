#include "tools/forecast/forecast_rig.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "tests/support/results.h"

namespace etude {
namespace {

std::vector<NamedCamera> Around(std::vector<double> angles_deg) {
  std::vector<NamedCamera> cameras;
  const Intrinsics in{.width = 1280, .height = 960, .fx = 700, .fy = 700, .cx = 640, .cy = 480};
  for (const double angle : angles_deg) {
    const glm::dvec3 p_WC(1 + 4 * std::sin(Radians(angle)), 1.5, -2 + 4 * std::cos(Radians(angle)));
    cameras.push_back({"cam" + std::to_string(cameras.size() + 1), LookAt(in, p_WC, {1, 1, -2})});
  }
  return cameras;
}

class ForecastRigTest : public ::testing::Test {
 protected:
  Result<RigForecast> Of(const std::vector<NamedCamera>& cameras, ForecastOptions options = {}) {
    options.rig = (folder_.path() / "rig.yaml").string();
    EXPECT_TRUE(WriteFileAtomically(options.rig, WriteRig(cameras)));
    return ForecastRig(options);
  }
  TemporaryFolder folder_ = TemporaryFolder::Make("forecast").value();
};

TEST_F(ForecastRigTest, StandsWhereTheCamerasLook) {
  ASSERT_OK(forecast, Of(Around({-40, 40, 160})));
  EXPECT_NEAR(forecast->middle_m.x, 1, 1e-6);
  EXPECT_NEAR(forecast->middle_m.y, -2, 1e-6);
  EXPECT_EQ(forecast->places.size(), 4000u);
  EXPECT_EQ(forecast->joints.size(), kRoleCount);
  for (const ForecastPlace& place : forecast->places) {
    EXPECT_LE(place.error_mm.value_or(0), *forecast->worst.error_mm);
  }
}

TEST_F(ForecastRigTest, PutsAnotherCameraAcrossTwoThatFaceEachOther) {
  ASSERT_OK(forecast, Of(Around({0, 180})));
  const RigWorth &own = forecast->worths.front(), &more = forecast->worths.back();
  ASSERT_TRUE(more.added_m);
  const double angle = Degrees(std::atan2(more.added_m->x - 1, more.added_m->z + 2));
  EXPECT_NEAR(std::abs(angle), 90, 25);
  EXPECT_LT(more.median_mm, 0.7 * own.median_mm);
  EXPECT_GE(more.seen, own.seen);
}

TEST_F(ForecastRigTest, HalvesWithThePixelsIfTheCalibrationIsPerfect) {
  ForecastOptions options;
  options.errors = {.noise_px = 4};
  ASSERT_OK(forecast, Of(Around({-40, 40}), options));
  EXPECT_NEAR(forecast->worths[1].median_mm, 0.5 * forecast->worths[0].median_mm, 1e-9);
  EXPECT_EQ(forecast->worths.size(), 3u) << "no better calibration than a perfect one";
}

TEST_F(ForecastRigTest, RefusesWhatHasNoForecast) {
  EXPECT_EQ(Of(Around({0})).error().message, "1 camera; allowed: 2 to 32");
  ForecastOptions options;
  options.middle_m = glm::dvec2(50, 0);
  const std::string message = Of(Around({-40, 40}), options).error().message;
  EXPECT_EQ(message.find("no place within 3 x 3 m around x 50.00, z 0.00"), 0u) << message;
  std::vector<NamedCamera> parallel = Around({0, 0});
  parallel[1].camera.p_WC.x += 0.5;
  EXPECT_NE(Of(parallel).error().message.find("--middle X,Z"), std::string::npos);
}

}  // namespace
}  // namespace etude
