#include "engine/capture/calibrate_cameras.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/capture/marked_body.h"
#include "tests/support/gtest_printers.h"

namespace etude {
namespace {

/// Ten points that fill a volume, as each camera sees them.
std::vector<std::vector<PointPair>> ExactPairs() {
  std::vector<std::vector<PointPair>> pairs;
  for (const ProjectionMatrix& camera : ThreeCameras()) {
    std::vector<PointPair>& of_camera = pairs.emplace_back();
    for (int i = 0; i < 10; ++i) {
      const glm::dvec3 point(0.8 * std::sin(1.7 * i), 1 + 0.8 * std::cos(2.3 * i), 0.8 * std::sin(0.9 * i + 1));
      of_camera.push_back({point, *Project(camera, point)});
    }
  }
  return pairs;
}

TEST(CalibrateCameras, GivesEveryCameraItsOwnMatrixBack) {
  for (const Calibration method : {Calibration::kDlt, Calibration::kDltNormalised}) {
    const auto matrices = CalibrateCameras(ExactPairs(), {.method = method});
    ASSERT_TRUE(matrices) << ToString(matrices.error());
    ASSERT_EQ(matrices->size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3 point(0.3, 0.7, -0.5);
      EXPECT_LT(glm::distance(*Project((*matrices)[i], point), *Project(ThreeCameras()[i], point)), 1e-6) << i;
    }
  }
}

TEST(CalibrateCameras, NamesTheCameraThatCannotBeCalibrated) {
  auto pairs = ExactPairs();
  pairs[1].resize(5);
  const auto matrices = CalibrateCameras(pairs);
  ASSERT_FALSE(matrices);
  EXPECT_THAT(matrices.error().message, testing::StartsWith("camera 2: cannot calibrate a camera: 5 point pairs"));
}

}  // namespace
}  // namespace etude
