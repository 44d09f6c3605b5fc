#include "engine/base/directions.h"
#include "engine/cameras/limb_direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/engine/cameras/camera_at.h"

namespace etude {
namespace {

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
    const LimbDirection limb = ComputeLimbDirection(left, StrokeOf(left, from, to), right, StrokeOf(right, from, to));
    if (limb.status != DirectionStatus::kOk) continue;
    ++checked;
    EXPECT_LT(Degrees(AngleBetween(limb.direction, along)), 1e-6) << i;
  }
  EXPECT_GT(checked, 30);
}

TEST(LimbDirection, NeedsOnlyTheLineNotTheEndsOfAStroke) {
  const ProjectionMatrix left = CameraAt(-40), right = CameraAt(40);
  const glm::dvec3 from(0.1, 0.6, 0.2), to(0.3, 1.2, -0.1);
  const LimbDirection limb = ComputeLimbDirection(left, StrokeOf(left, glm::mix(from, to, 0.2), to), right,
                                                  StrokeOf(right, from, glm::mix(from, to, 0.5)));
  ASSERT_EQ(limb.status, DirectionStatus::kOk);
  EXPECT_LT(Degrees(AngleBetween(limb.direction, to - from)), 1e-6);
}

TEST(LimbDirection, TurnsRoundWhenTheStrokesDo) {
  const ProjectionMatrix left = CameraAt(-40), right = CameraAt(40);
  const glm::dvec3 from(0.1, 0.6, 0.2), to(0.3, 1.2, -0.1);
  const LimbDirection limb = ComputeLimbDirection(left, StrokeOf(left, to, from), right, StrokeOf(right, to, from));
  EXPECT_LT(Degrees(AngleBetween(limb.direction, from - to)), 1e-6);
}

TEST(LimbDirection, BelievesThePictureInWhichTheLimbIsLessForeshortened) {
  // A limb that almost points at one camera is a stroke of few pixels there, which noise can turn round. Only that
  // one is turned here, so the limb's true direction is the exact answer, whichever camera it is.
  for (double foreshortened_at : {-40.0, 40.0}) {
    const ProjectionMatrix short_view = CameraAt(foreshortened_at), full_view = CameraAt(-foreshortened_at);
    const glm::dvec3 eye = EyeAt(foreshortened_at), from(0.1, 1.1, 0.05);
    const glm::dvec3 to = from + 0.3 * glm::normalize(glm::normalize(eye - from) + glm::dvec3(0.02, 0.03, -0.01));
    const PixelSegment turned = StrokeOf(short_view, to, from), seen = StrokeOf(full_view, from, to);
    ASSERT_LT(glm::distance(turned.a, turned.b), 0.2 * glm::distance(seen.a, seen.b));
    for (const LimbDirection& limb : {ComputeLimbDirection(short_view, turned, full_view, seen),
                                      ComputeLimbDirection(full_view, seen, short_view, turned)}) {
      ASSERT_EQ(limb.status, DirectionStatus::kOk);
      EXPECT_LT(Degrees(AngleBetween(limb.direction, to - from)), 1e-6);
    }
  }
}

TEST(LimbDirection, ReportsTheAngleBetweenThePlanes) {
  // Seen from ±40° at its own height, an upright limb on the axis lies in planes 80° apart.
  auto level = [](double degrees) {
    const double a = Radians(degrees);
    return MatrixOf(LookAt({}, {4 * std::sin(a), 1, 4 * std::cos(a)}, {0, 1, 0}));
  };
  const glm::dvec3 from(0, 0.8, 0), to(0, 1.2, 0);
  const LimbDirection limb =
      ComputeLimbDirection(level(-40), StrokeOf(level(-40), from, to), level(40), StrokeOf(level(40), from, to));
  EXPECT_NEAR(Degrees(limb.plane_angle), 80, 1e-9);
}

TEST(LimbDirection, IsIllConditionedForALimbInAPlaneThroughBothCameras) {
  const ProjectionMatrix left = CameraAt(-40), right = CameraAt(40);
  // The plane of both eyes and the target, in which this limb lies.
  const glm::dvec3 middle(0, 0.9, 0), across(0.2, 0.9, 0);
  const LimbDirection limb =
      ComputeLimbDirection(left, StrokeOf(left, middle, across), right, StrokeOf(right, middle, across));
  EXPECT_EQ(limb.status, DirectionStatus::kIllConditioned);
  EXPECT_LT(Degrees(limb.plane_angle), 1e-6);
  EXPECT_EQ(limb.direction, glm::dvec3(0));
}

TEST(LimbDirection, NeedsPlanesThatAreFartherFromParallelThanAsked) {
  // Level cameras at ±half see an upright limb on the axis in planes that are twice that apart.
  auto status_at = [](double half, double smallest) {
    auto level = [](double degrees) {
      const double a = Radians(degrees);
      return MatrixOf(LookAt({}, {4 * std::sin(a), 1, 4 * std::cos(a)}, {0, 1, 0}));
    };
    const glm::dvec3 from(0, 0.8, 0), to(0, 1.2, 0);
    const ProjectionMatrix left = level(-half), right = level(half);
    const PixelSegment in_left = StrokeOf(left, from, to), in_right = StrokeOf(right, from, to);
    return smallest > 0 ? ComputeLimbDirection(left, in_left, right, in_right, Radians(smallest)).status
                        : ComputeLimbDirection(left, in_left, right, in_right).status;
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
  EXPECT_EQ(ComputeLimbDirection(left, StrokeOf(left, from, from), right, good).status,
            DirectionStatus::kIllConditioned);
  const PixelSegment broken{{std::numeric_limits<double>::quiet_NaN(), 1}, {2, 3}};
  EXPECT_EQ(ComputeLimbDirection(left, broken, right, good).status, DirectionStatus::kIllConditioned);
}

}  // namespace
}  // namespace etude
