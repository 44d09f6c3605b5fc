#include "engine/capture/calibrate_cameras.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/kinematics/body_tree.h"
#include "tests/engine/capture/marked_body.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

/// Returns each camera's view of ten points that fill a volume.
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
    ASSERT_OK(matrices, CalibrateCameras(ExactPairs(), {.method = method}));
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
  EXPECT_THAT(testing::Message(CalibrateCameras(pairs)),
              ::testing::StartsWith("camera 2: cannot calibrate a camera: found 5 point pairs"));
}

/// Two cameras with lenses, and their views of a volume.
std::vector<Camera> LensCameras() {
  const Intrinsics in{.width = 640, .height = 480, .fx = 600, .fy = 590, .cx = 322, .cy = 236, .skew = 0};
  std::vector<Camera> cameras{LookAt(in, {2, 1.4, 3}, {0, 1, 0}), LookAt(in, {-2.2, 2, 2.5}, {0, 1, 0})};
  for (Camera& camera : cameras) camera.distortion = {.k1 = -0.15, .k2 = 0.04, .p1 = 0.001, .p2 = 0.002};
  return cameras;
}

TEST(RefineCameras, FindsLensesThatAMatrixCannotTell) {
  std::vector<std::vector<PointPair>> pairs;
  for (const Camera& camera : LensCameras()) {
    std::vector<PointPair>& of_camera = pairs.emplace_back();
    for (int i = 0; i < 40; ++i) {
      const glm::dvec3 point(0.9 * std::sin(1.7 * i), 1 + 0.9 * std::cos(2.3 * i), 0.9 * std::sin(0.9 * i + 1));
      of_camera.push_back({point, *Project(camera, point)});
    }
  }
  const std::vector<PictureSize> sizes(2, PictureSize{640, 480});
  ASSERT_OK(cameras, RefineCameras(pairs, sizes));
  ASSERT_OK(matrices, CalibrateCameras(pairs, {.method = Calibration::kDltNormalised}));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR((*cameras)[i].distortion.k1, -0.15, 1e-9);
    EXPECT_LT(glm::distance((*cameras)[i].p_WC, LensCameras()[i].p_WC), 1e-9);
    EXPECT_GT(ReprojectionRms((*matrices)[i], pairs[i]), 0.05) << "the control: a matrix leaves the lens's error";
  }
  pairs[1].resize(6);
  EXPECT_THAT(RefineCameras(pairs, sizes).error().message,
              ::testing::StartsWith("camera 2: 6 points give 12 equations"));
}

TEST(UndistortMarks, ShowsWhatAPinholeWouldShow) {
  const Camera camera = LensCameras()[0];
  const glm::dvec3 from(0.7, 0.3, 0.2), to(0.8, 1.6, -0.1), end(-0.6, 1.8, 0.4);
  Marks marks;
  marks.strokes[3] = PixelSegment{*Project(camera, from), *Project(camera, to)};
  marks.effectors[2] = *Project(camera, end);
  const Marks straight = UndistortMarks(camera, marks);
  const ProjectionMatrix pinhole = MatrixOf(camera);
  EXPECT_LT(glm::distance(straight.strokes[3]->a, *Project(pinhole, from)), 1e-8);
  EXPECT_LT(glm::distance(straight.strokes[3]->b, *Project(pinhole, to)), 1e-8);
  EXPECT_LT(glm::distance(*straight.effectors[2], *Project(pinhole, end)), 1e-8);
  EXPECT_GT(glm::distance(*straight.effectors[2], *marks.effectors[2]), 0.3) << "the control: the lens does something";
  EXPECT_FALSE(straight.strokes[0] || straight.effectors[0]);
}

}  // namespace
}  // namespace etude
