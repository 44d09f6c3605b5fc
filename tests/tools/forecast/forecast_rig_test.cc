#include "tools/forecast/forecast_rig.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "io/images/image_files.h"
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

TEST_F(ForecastRigTest, NamesCamerasThatLookAwayOrLieBelowTheFloor) {
  std::vector<NamedCamera> cameras = Around({-40, 40, 160});
  EXPECT_EQ(Of(cameras)->doubts, std::vector<std::string>());
  Camera& third = cameras[2].camera;
  third.R_CW = glm::dmat3(-1, 0, 0, 0, 1, 0, 0, 0, -1) * third.R_CW;
  ForecastOptions options;
  options.middle_m = {1, -2};
  EXPECT_EQ(Of(cameras, options)->doubts,
            std::vector<std::string>{"doubtful: cam3: this camera sees no place of the volume"});
  cameras = Around({-40, 40, 160});
  cameras[1].camera.p_WC.y = -0.5;
  ASSERT_OK(low, Of(cameras));
  ASSERT_EQ(low->doubts.size(), 1u);
  EXPECT_THAT(low->doubts[0], ::testing::StartsWith("doubtful: cameras are below the floor: cam2 by 0.50 m;"));
}

TEST_F(ForecastRigTest, PutsAnotherCameraAcrossTwoThatFaceEachOther) {
  ForecastOptions options;
  options.room_m = {10, 3, 10};
  ASSERT_OK(forecast, Of(Around({0, 180}), options));
  const RigWorth &own = forecast->worths.front(), &more = forecast->worths.back();
  ASSERT_TRUE(more.added_m);
  const double angle = Degrees(std::atan2(more.added_m->x - 1, more.added_m->z + 2));
  EXPECT_NEAR(std::abs(angle), 90, 25);
  EXPECT_LT(more.median_mm, 0.7 * own.median_mm);
  EXPECT_GE(more.seen, own.seen);
}

TEST_F(ForecastRigTest, PutsAnotherCameraIntoTheRoom) {
  // The cameras stand at z -6 and 2, 1.5 m high; the volume reaches from x -0.5 to 2.5, and to 2 m.
  const auto added = [&](const ForecastOptions& options) {
    return *Of(Around({0, 180}), options).value().worths.back().added_m;
  };
  const glm::dvec3 p = added({});
  EXPECT_TRUE(p.x >= -0.5 && p.x <= 2.5 && p.z >= -6 && p.z <= 2 && p.y <= 2) << p.x << " " << p.y << " " << p.z;
  ForecastOptions options;
  options.room_m = {5, 1, 5};
  const glm::dvec3 low = added(options);
  EXPECT_TRUE(low.x >= -1.5 && low.x <= 3.5 && low.z >= -4.5 && low.z <= 0.5 && low.y <= 1) << low.x << " " << low.z;
  options.room_m = {10, 3, 10};
  EXPECT_GT(std::abs(added(options).x - 1), 2.5) << "a larger room is used";
}

TEST_F(ForecastRigTest, ComputesAtRoundPlaces) {
  std::vector<NamedCamera> cameras = Around({-40, 40, 160});
  for (NamedCamera& camera : cameras) camera.camera.p_WC += glm::dvec3(3e-10, 2e-10, -4e-10);
  ForecastOptions options;
  options.table = (folder_.path() / "map.csv").string();
  ASSERT_OK(forecast, Of(cameras, options));
  EXPECT_EQ(forecast->middle_m, glm::dvec2(1, -2));
  const std::string table = ReadWholeFile(options.table).value();
  EXPECT_NE(table.find("\n-0.425,0.1,-3.425,"), std::string::npos) << table.substr(0, 200);
}

TEST_F(ForecastRigTest, DrawsTheVolumeTrueToScale) {
  // All errors are the same, so the first map is one box of the scale's first colour.
  RigForecast forecast;
  const double away = 3;
  for (const double angle : {0.0, 90.0})
    forecast.cameras.push_back(
        {"cam", LookAt({}, {away * std::sin(Radians(angle)), 1, away * std::cos(Radians(angle))}, {})});
  forecast.places.assign(std::size_t{kForecastColumns} * kForecastHeights * kForecastRows, {.error_mm = 10});
  forecast.worst = {.place_m = {0, 9, 0}, .error_mm = 10};
  forecast.p95_mm = 11;
  for (const auto& [size, pixels] :
       {std::pair(glm::dvec3(4, 2, 5), 128 * 160), {{5, 2, 4}, 160 * 128}, {{2, 1, 2}, 160 * 160}}) {
    const std::string png = ForecastPicture(forecast, {.size_m = size});
    ASSERT_OK(picture, DecodeColourPng(png, 1 << 20));
    const auto first = picture->At(430, 110);
    int same = 0;
    for (int y = 90; y < 262; ++y) {
      for (int x = 410; x < 584; ++x) same += picture->At(x, y) == first;
    }
    EXPECT_EQ(same, pixels) << size.x << " x " << size.z;
  }
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
  EXPECT_EQ(message.find("two cameras see no common place within 3 x 3 m around x 50.00, z 0.00"), 0u) << message;
  std::vector<NamedCamera> parallel = Around({0, 0});
  parallel[1].camera.p_WC.x += 0.5;
  EXPECT_NE(Of(parallel).error().message.find("--middle X,Z"), std::string::npos);
}

}  // namespace
}  // namespace etude
