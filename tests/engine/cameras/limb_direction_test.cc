#include "engine/base/directions.h"
#include "engine/cameras/limb_direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/engine/cameras/camera_at.h"

namespace etude {
namespace {

/// Computes the direction from two cameras, which is paper B's case. `angle`, if given, replaces the default of the
/// smallest allowed angle between the two planes.
template <typename... Angle>
LimbDirection DirectionOfTwo(const ProjectionMatrix& matrix1, const PixelSegment& stroke1,
                             const ProjectionMatrix& matrix2, const PixelSegment& stroke2, Angle... angle) {
  const LimbSighting sightings[] = {{matrix1, stroke1}, {matrix2, stroke2}};
  return ComputeLimbDirection(sightings, angle...);
}

PixelSegment StrokeOf(const ProjectionMatrix& matrix, const glm::dvec3& from, const glm::dvec3& to) {
  return {*Project(matrix, from), *Project(matrix, to)};
}

TEST(ViewingRay, PassesThroughThePointThatThePixelShows) {
  const ProjectionMatrix matrix = CameraAt(35);
  const glm::dvec3 eye = EyeAt(35);
  const glm::dvec3 point(-0.3, 1.7, 0.2);
  EXPECT_LT(AngleBetween(ViewingRay(matrix, *Project(matrix, point)), point - eye), 1e-9);
}

TEST(LimbDirection, IsExactForExactStrokesAndRunsFromAToB) {
  const ProjectionMatrix left = CameraAt(-40), right = CameraAt(40);
  int checked = 0;
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 from(0.3 * std::sin(i), 1 + 0.4 * std::cos(2 * i), 0.3 * std::cos(3 * i));
    const glm::dvec3 along = glm::normalize(glm::dvec3(std::sin(5 * i), std::cos(7 * i), std::sin(11 * i + 1)));
    const glm::dvec3 to = from + 0.3 * along;
    const LimbDirection limb = DirectionOfTwo(left, StrokeOf(left, from, to), right, StrokeOf(right, from, to));
    if (limb.status != DirectionStatus::kOk) continue;
    ++checked;
    EXPECT_LT(Degrees(AngleBetween(limb.direction, along)), 1e-6) << i;
  }
  EXPECT_GT(checked, 30);
}

TEST(LimbDirection, NeedsOnlyTheLineNotTheEndsOfAStroke) {
  const ProjectionMatrix left = CameraAt(-40), right = CameraAt(40);
  const glm::dvec3 from(0.1, 0.6, 0.2), to(0.3, 1.2, -0.1);
  const LimbDirection limb = DirectionOfTwo(left, StrokeOf(left, glm::mix(from, to, 0.2), to), right,
                                            StrokeOf(right, from, glm::mix(from, to, 0.5)));
  ASSERT_EQ(limb.status, DirectionStatus::kOk);
  EXPECT_LT(Degrees(AngleBetween(limb.direction, to - from)), 1e-6);
}

TEST(LimbDirection, TurnsRoundWhenTheStrokesDo) {
  const ProjectionMatrix left = CameraAt(-40), right = CameraAt(40);
  const glm::dvec3 from(0.1, 0.6, 0.2), to(0.3, 1.2, -0.1);
  const LimbDirection limb = DirectionOfTwo(left, StrokeOf(left, to, from), right, StrokeOf(right, to, from));
  EXPECT_LT(Degrees(AngleBetween(limb.direction, from - to)), 1e-6);
}

TEST(LimbDirection, BelievesThePictureInWhichTheLimbIsLessForeshortened) {
  // A limb that points almost at a camera gives a stroke of few pixels, which noise may reverse. Only this stroke is
  // reversed here, so the true direction is the exact answer for either camera.
  for (double foreshortened_at : {-40.0, 40.0}) {
    const ProjectionMatrix short_view = CameraAt(foreshortened_at), full_view = CameraAt(-foreshortened_at);
    const glm::dvec3 eye = EyeAt(foreshortened_at), from(0.1, 1.1, 0.05);
    const glm::dvec3 to = from + 0.3 * glm::normalize(glm::normalize(eye - from) + glm::dvec3(0.02, 0.03, -0.01));
    const PixelSegment turned = StrokeOf(short_view, to, from), seen = StrokeOf(full_view, from, to);
    ASSERT_LT(glm::distance(turned.a, turned.b), 0.2 * glm::distance(seen.a, seen.b));
    for (const LimbDirection& limb :
         {DirectionOfTwo(short_view, turned, full_view, seen), DirectionOfTwo(full_view, seen, short_view, turned)}) {
      ASSERT_EQ(limb.status, DirectionStatus::kOk);
      EXPECT_LT(Degrees(AngleBetween(limb.direction, to - from)), 1e-6);
    }
  }
}

TEST(LimbDirection, ReportsTheAngleBetweenThePlanes) {
  // The cameras are at ±40° around the Y axis and at the limb's height, so their planes through an upright limb on this
  // axis meet at 80°.
  auto level = [](double degrees) {
    const double a = Radians(degrees);
    return MatrixOf(LookAt({}, {4 * std::sin(a), 1, 4 * std::cos(a)}, {0, 1, 0}));
  };
  const glm::dvec3 from(0, 0.8, 0), to(0, 1.2, 0);
  const LimbDirection limb =
      DirectionOfTwo(level(-40), StrokeOf(level(-40), from, to), level(40), StrokeOf(level(40), from, to));
  EXPECT_NEAR(Degrees(limb.plane_angle), 80, 1e-9);
}

TEST(LimbDirection, IsIllConditionedForALimbInAPlaneThroughBothCameras) {
  const ProjectionMatrix left = CameraAt(-40), right = CameraAt(40);
  // This limb lies in the plane of both eyes and the target.
  const glm::dvec3 middle(0, 0.9, 0), across(0.2, 0.9, 0);
  const LimbDirection limb =
      DirectionOfTwo(left, StrokeOf(left, middle, across), right, StrokeOf(right, middle, across));
  EXPECT_EQ(limb.status, DirectionStatus::kIllConditioned);
  EXPECT_LT(Degrees(limb.plane_angle), 1e-6);
  EXPECT_EQ(limb.direction, glm::dvec3(0));
}

TEST(LimbDirection, NeedsPlanesThatAreFartherFromParallelThanAsked) {
  // The cameras are at ±`half` degrees around the Y axis and at the limb's height. Their planes through an upright limb
  // on this axis meet at an angle of 2 · `half`.
  auto status_at = [](double half, double smallest) {
    auto level = [](double degrees) {
      const double a = Radians(degrees);
      return MatrixOf(LookAt({}, {4 * std::sin(a), 1, 4 * std::cos(a)}, {0, 1, 0}));
    };
    const glm::dvec3 from(0, 0.8, 0), to(0, 1.2, 0);
    const ProjectionMatrix left = level(-half), right = level(half);
    const PixelSegment in_left = StrokeOf(left, from, to), in_right = StrokeOf(right, from, to);
    return smallest > 0 ? DirectionOfTwo(left, in_left, right, in_right, Radians(smallest)).status
                        : DirectionOfTwo(left, in_left, right, in_right).status;
  };
  EXPECT_EQ(status_at(4.9, 10), DirectionStatus::kIllConditioned);
  EXPECT_EQ(status_at(5.1, 10), DirectionStatus::kOk);
  EXPECT_EQ(status_at(90 - 4.9, 10), DirectionStatus::kIllConditioned) << "the cameras face each other";
  EXPECT_EQ(status_at(90 - 5.1, 10), DirectionStatus::kOk);
  EXPECT_EQ(status_at(1.4, 0), DirectionStatus::kIllConditioned) << "3 degrees unless asked";
  EXPECT_EQ(status_at(1.6, 0), DirectionStatus::kOk);
}

TEST(LimbDirection, IsIllConditionedForAStrokeWithoutLengthOrNotFinite) {
  const ProjectionMatrix left = CameraAt(-40), right = CameraAt(40);
  const glm::dvec3 from(0.1, 0.6, 0.2), to(0.3, 1.2, -0.1);
  const PixelSegment good = StrokeOf(right, from, to);
  EXPECT_EQ(DirectionOfTwo(left, StrokeOf(left, from, from), right, good).status, DirectionStatus::kIllConditioned);
  const PixelSegment broken{{std::numeric_limits<double>::quiet_NaN(), 1}, {2, 3}};
  EXPECT_EQ(DirectionOfTwo(left, broken, right, good).status, DirectionStatus::kIllConditioned);
}

const glm::dvec3 kFrom(0.1, 0.6, 0.2), kTo(0.3, 1.2, -0.1);

ProjectionMatrix CameraOf(int i) {
  const double a = Radians(-40 + 65 * i);
  return MatrixOf(LookAt({}, {3.8 * std::sin(a), 1 + 0.3 * i, 3.8 * std::cos(a)}, {0, 0.9, 0}));
}

/// Returns the limb as `count` cameras see it, with errors of `error_px`.
std::vector<LimbSighting> Sightings(int count, double error_px = 0) {
  std::vector<LimbSighting> sightings;
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 error = error_px * glm::dvec2(std::sin(37 * i + 1), std::cos(91 * i));
    sightings.push_back({CameraOf(i), {*Project(CameraOf(i), kFrom) + error, *Project(CameraOf(i), kTo) - error}});
  }
  return sightings;
}

/// Returns Σ (N · d / c)² over the cameras; c is the change of N · d per pixel of error at the stroke's ends.
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
  const LimbDirection paper = DirectionOfTwo(two[0].matrix, two[0].stroke, two[1].matrix, two[1].stroke);
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
