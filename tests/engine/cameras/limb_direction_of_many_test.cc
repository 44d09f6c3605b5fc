#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "engine/base/directions.h"
#include "engine/cameras/limb_direction.h"

namespace etude {
namespace {

const glm::dvec3 kFrom(0.1, 0.6, 0.2), kTo(0.3, 1.2, -0.1);

ProjectionMatrix CameraOf(int i) {
  const double a = Radians(-40 + 65 * i);
  return MatrixOf(LookAt({}, {3.8 * std::sin(a), 1 + 0.3 * i, 3.8 * std::cos(a)}, {0, 0.9, 0}));
}

/// The limb as `count` cameras see it, each mark off by `error_px`.
std::vector<LimbSighting> Sightings(int count, double error_px = 0) {
  std::vector<LimbSighting> sightings;
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 error = error_px * glm::dvec2(std::sin(37 * i + 1), std::cos(91 * i));
    sightings.push_back({CameraOf(i), {*Project(CameraOf(i), kFrom) + error, *Project(CameraOf(i), kTo) - error}});
  }
  return sightings;
}

/// Each normal's part along the direction, in units of what a pixel at the stroke's ends makes of it.
double SumOfSquares(const std::vector<LimbSighting>& sightings, const glm::dvec3& direction) {
  double sum = 0;
  for (const LimbSighting& s : sightings) {
    const glm::dvec3 a = glm::normalize(ViewingRay(s.matrix, s.stroke.a));
    const glm::dvec3 b = glm::normalize(ViewingRay(s.matrix, s.stroke.b));
    const double per_px =
        glm::length(glm::cross(glm::normalize(a + b), kTo - kFrom)) / glm::distance(s.stroke.a, s.stroke.b);
    const double part = glm::dot(glm::normalize(glm::cross(a, b)), direction) / per_px;
    sum += part * part;
  }
  return sum;
}

TEST(LimbDirectionOfMany, IsExactForExactStrokesOfAnyNumberOfCameras) {
  for (int count = 2; count <= 5; ++count) {
    const LimbDirection limb = ComputeLimbDirection(Sightings(count));
    ASSERT_EQ(limb.status, DirectionStatus::kOk) << count;
    EXPECT_LT(Degrees(AngleBetween(limb.direction, kTo - kFrom)), 1e-6) << count;
    EXPECT_NEAR(glm::length(limb.direction), 1, 1e-12) << count;
  }
}

TEST(LimbDirectionOfMany, IsTheLeastSquaresOne) {
  const auto sightings = Sightings(4, 6);
  const LimbDirection limb = ComputeLimbDirection(sightings);
  ASSERT_EQ(limb.status, DirectionStatus::kOk);
  const double least = SumOfSquares(sightings, limb.direction);
  EXPECT_GT(least, 1e-6) << "the strokes disagree";
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 step(std::sin(5 * i), std::cos(7 * i), std::sin(11 * i + 1));
    EXPECT_GT(SumOfSquares(sightings, glm::normalize(limb.direction + 0.05 * step)), least) << i;
  }
  EXPECT_LT(Degrees(AngleBetween(limb.direction, kTo - kFrom)), 10);
}

TEST(LimbDirectionOfMany, OfTwoCamerasIsPaperBsToTheBit) {
  const auto two = Sightings(2, 6);
  const LimbDirection many = ComputeLimbDirection(two);
  const LimbDirection paper = ComputeLimbDirection(two[0].matrix, two[0].stroke, two[1].matrix, two[1].stroke);
  EXPECT_EQ(many.direction, paper.direction);
  EXPECT_EQ(many.plane_angle, paper.plane_angle);
}

TEST(LimbDirectionOfMany, LeavesOutStrokesThatAreNone) {
  auto sightings = Sightings(3, 6);
  const LimbDirection of_two = ComputeLimbDirection(std::span(sightings).first(2));
  sightings[2].stroke.b = sightings[2].stroke.a;
  EXPECT_EQ(ComputeLimbDirection(sightings).direction, of_two.direction);
  sightings[2].stroke.b.x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ComputeLimbDirection(sightings).direction, of_two.direction);
}

TEST(LimbDirectionOfMany, TellsTheLargestAngleBetweenTwoPlanes) {
  const auto sightings = Sightings(3);
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const std::vector<LimbSighting> pair = {sightings[i], sightings[j]};
      largest = std::max(largest, ComputeLimbDirection(pair, 0).plane_angle);
    }
  }
  EXPECT_EQ(ComputeLimbDirection(sightings).plane_angle, largest);
  EXPECT_EQ(ComputeLimbDirection(sightings, largest).status, DirectionStatus::kOk);
  EXPECT_EQ(ComputeLimbDirection(sightings, largest + 1e-9).status, DirectionStatus::kIllConditioned);
}

TEST(LimbDirectionOfMany, IsIllConditionedForFewerThanTwo) {
  EXPECT_EQ(ComputeLimbDirection({}, 0).status, DirectionStatus::kIllConditioned);
  EXPECT_EQ(ComputeLimbDirection(Sightings(1), 0).status, DirectionStatus::kIllConditioned);
  const auto once = Sightings(1)[0];
  EXPECT_EQ(ComputeLimbDirection(std::vector{once, once, once}, 0).status, DirectionStatus::kIllConditioned);
}

}  // namespace
}  // namespace etude
