#include "engine/cameras/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "engine/base/angles.h"

namespace etude {
namespace {

ProjectionMatrix CameraAt(double degrees) {
  const double a = Radians(degrees);
  return MatrixOf(LookAt({}, {3.8 * std::sin(a), 1.4, 3.8 * std::cos(a)}, {0, 0.9, 0}));
}

Sighting SightingOf(const ProjectionMatrix& matrix, const glm::dvec3& point) {
  return {matrix, *Project(matrix, point)};
}

TEST(Triangulation, FindsThePointThatTwoOrMoreCamerasSee) {
  const glm::dvec3 point(0.4, 1.3, -0.6);
  std::vector<Sighting> sightings;
  for (double degrees : {-40.0, 40.0, 95.0, 170.0}) {
    sightings.push_back(SightingOf(CameraAt(degrees), point));
    if (sightings.size() < 2) continue;
    const TriangulatedPoint found = Triangulate(sightings);
    ASSERT_EQ(found.status, PointStatus::kOk);
    EXPECT_LT(glm::distance(found.position, point), 1e-9);
    EXPECT_LT(found.residual_px, 1e-6);
  }
}

TEST(Triangulation, SplitsADisagreementEvenlyBetweenEqualCameras) {
  // Both cameras see the point h pixels too high resp. too low: the rows differ in v only, so the
  // point stays where it is and each picture is off by h.
  const glm::dvec3 point(0, 0.9, 0);
  Sighting left = SightingOf(CameraAt(-40), point), right = SightingOf(CameraAt(40), point);
  left.pixel.y += 2;
  right.pixel.y -= 2;
  const TriangulatedPoint found = Triangulate(std::vector{left, right});
  ASSERT_EQ(found.status, PointStatus::kOk);
  EXPECT_LT(glm::distance(found.position, point), 2e-3);
  EXPECT_NEAR(found.residual_px, 2, 0.02);
}

TEST(Triangulation, DoesNotDependOnTheScaleOfH) {
  const glm::dvec3 point(0.2, 0.5, 0.3);
  Sighting left = SightingOf(CameraAt(-40), point), right = SightingOf(CameraAt(40), point);
  left.pixel += glm::dvec2(3, -1);
  const glm::dvec3 before = Triangulate(std::vector{left, right}).position;
  for (auto& row : left.matrix.h) {
    for (double& entry : row) entry *= 1000;
  }
  EXPECT_LT(glm::distance(Triangulate(std::vector{left, right}).position, before), 1e-9);
}

TEST(Triangulation, SaysWhenOneCameraIsNotEnough) {
  EXPECT_EQ(Triangulate({}).status, PointStatus::kTooFewViews);
  EXPECT_EQ(Triangulate(std::vector{SightingOf(CameraAt(0), {0, 1, 0})}).status, PointStatus::kTooFewViews);
}

TEST(Triangulation, RefusesAPointBehindACamera) {
  // Rays that diverge meet behind both cameras: eyes half a metre apart that look outwards.
  const ProjectionMatrix left = MatrixOf(LookAt({}, {-0.25, 1, 0}, {-1.25, 1, -4}));
  const ProjectionMatrix right = MatrixOf(LookAt({}, {0.25, 1, 0}, {1.25, 1, -4}));
  const TriangulatedPoint found = Triangulate(std::vector<Sighting>{{left, {320, 240}}, {right, {320, 240}}});
  EXPECT_EQ(found.status, PointStatus::kIllConditioned);
  const glm::dvec3 before(0, 1, -3);
  EXPECT_EQ(Triangulate(std::vector{SightingOf(left, before), SightingOf(right, before)}).status, PointStatus::kOk)
      << "the control: the same cameras, a point before them";
}

TEST(Triangulation, NeedsMoreThanAHundredthOfADegreeBetweenItsRays) {
  const glm::dvec3 point(0, 1, 0);
  auto status_at = [&](double degrees) {
    return Triangulate(std::vector{SightingOf(CameraAt(0), point), SightingOf(CameraAt(degrees), point)}).status;
  };
  EXPECT_EQ(status_at(0.01), PointStatus::kIllConditioned);
  EXPECT_EQ(status_at(1), PointStatus::kOk);
}

TEST(Triangulation, SaysWhenTheRaysAreParallelOrNotFinite) {
  const glm::dvec3 point(0.1, 1, 0);
  const Sighting once = SightingOf(CameraAt(20), point);
  EXPECT_EQ(Triangulate(std::vector{once, once}).status, PointStatus::kIllConditioned);
  Sighting broken = SightingOf(CameraAt(-20), point);
  broken.pixel.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(Triangulate(std::vector{once, broken}).status, PointStatus::kIllConditioned);
}

}  // namespace
}  // namespace etude
