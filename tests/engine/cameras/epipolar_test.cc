#include "engine/cameras/epipolar.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "engine/cameras/triangulation.h"
#include "tests/engine/cameras/camera_at.h"

namespace etude {
namespace {

const glm::dvec3 kSeen(0.3, 1.2, -0.4);

TEST(EpipolarGeometry, OfOnePointsPixelsTheDistanceIsNothing) {
  const auto geometry = EpipolarGeometry::Of(CameraAt(-30), CameraAt(50));
  ASSERT_TRUE(geometry);
  EXPECT_NEAR(geometry->DistancePx(*Project(CameraAt(-30), kSeen), *Project(CameraAt(50), kSeen)), 0, 1e-9);
}

/// A second way there: the point that both pixels are nearest to, and how far off it they are.
TEST(EpipolarGeometry, IsTheResidualOfTriangulationToFirstOrder) {
  const std::array cameras = {CameraAt(-30), CameraAt(50)};
  const auto geometry = EpipolarGeometry::Of(cameras[0], cameras[1]);
  for (const glm::dvec2& off : {glm::dvec2(0, 3), {2, -2}, {-1, 5}}) {
    const std::array<Sighting, 2> sightings = {
        {{cameras[0], *Project(cameras[0], kSeen) + off}, {cameras[1], *Project(cameras[1], kSeen)}}};
    const double residual = TriangulateByPixels(sightings).residual_px;
    EXPECT_NEAR(std::abs(geometry->DistancePx(sightings[0].pixel, sightings[1].pixel)), residual, 0.02 * residual);
    EXPECT_GT(residual, 0.1) << "the control";
  }
}

}  // namespace
}  // namespace etude
