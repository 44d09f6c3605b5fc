#include "engine/base/euler.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/nearest_rotation.h"

namespace etude {
namespace {

double Difference(const glm::dmat3& a, const glm::dmat3& b) {
  double largest = 0;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) largest = std::max(largest, std::abs(a[c][r] - b[c][r]));
  }
  return largest;
}

TEST(Euler, RotationXyzIsTheProductOfThreeAxisRotations) {
  const glm::dvec3 angles(0.3, -1.1, 2.5);
  const glm::dmat3 product =
      AxisRotation({1, 0, 0}, 0.3) * AxisRotation({0, 1, 0}, -1.1) * AxisRotation({0, 0, 1}, 2.5);
  EXPECT_LT(Difference(RotationXyz(angles), product), 1e-15);
  EXPECT_GT(Difference(RotationXyz({2.5, -1.1, 0.3}), product), 0.1) << "the order must matter";
}

TEST(Euler, AQuarterTurnAboutZTurnsXIntoY) {
  EXPECT_LT(glm::length(AxisRotation({0, 0, 1}, kPi / 2) * glm::dvec3(1, 0, 0) - glm::dvec3(0, 1, 0)), 1e-15);
}

TEST(Euler, AnglesComeBackFromTheirRotation) {
  for (double x : {-3.0, -0.5, 0.0, 1.2, 3.1}) {
    for (double y : {-1.5, -0.2, 0.0, 0.9, 1.5}) {
      for (double z : {-2.9, 0.0, 0.4, 2.2}) {
        EXPECT_LT(glm::length(AnglesXyz(RotationXyz({x, y, z})) - glm::dvec3(x, y, z)), 1e-12) << x << y << z;
      }
    }
  }
}

TEST(Euler, AnglesAtAndNearThePolesStillMakeTheSameRotation) {
  for (double y : {-kPi / 2, kPi / 2, kPi / 2 - 1e-11, kPi / 2 - 1e-8, 1e-5 - kPi / 2}) {
    const glm::dmat3 rotation = RotationXyz({0.7, y, -1.3});
    EXPECT_LT(Difference(RotationXyz(AnglesXyz(rotation)), rotation), 1e-10) << y;
  }
}

TEST(Euler, SmallestRotationTurnsAboutTheCommonNormalOnly) {
  const glm::dvec3 from = glm::normalize(glm::dvec3(1, 2, 3)), to = glm::normalize(glm::dvec3(-2, 1, 0.5));
  const glm::dmat3 rotation = SmallestRotation(from, to);
  const glm::dvec3 normal = glm::normalize(glm::cross(from, to));
  EXPECT_LT(glm::length(rotation * from - to), 1e-14);
  EXPECT_LT(glm::length(rotation * normal - normal), 1e-14);
}

TEST(Euler, SmallestRotationOfOppositeVectorsIsHalfATurn) {
  for (const glm::dvec3& v : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0.6, 0, 0.8)}) {
    const glm::dmat3 rotation = SmallestRotation(v, -v);
    EXPECT_LT(glm::length(rotation * v + v), 1e-14);
    EXPECT_NEAR(glm::determinant(rotation), 1, 1e-14);
  }
}

TEST(Euler, SmallestRotationOfOppositeVectorsTurnsAboutTheCoordinateAxisLeastAlongThem) {
  // The matrix of a half turn about the unit vector a is 2aaᵀ − I. For vectors normal to one coordinate axis, this axis
  // must be a.
  const auto axis_of = [](const glm::dvec3& v) {
    const glm::dmat3 rotation = SmallestRotation(v, -v);
    return glm::dvec3(rotation[0][0], rotation[1][1], rotation[2][2]);  // 2 a² − 1 per component
  };
  EXPECT_LT(glm::length(axis_of({0, 0.6, 0.8}) - glm::dvec3(1, -1, -1)), 1e-14);
  EXPECT_LT(glm::length(axis_of({0.6, 0, 0.8}) - glm::dvec3(-1, 1, -1)), 1e-14);
  EXPECT_LT(glm::length(axis_of({0.6, 0.8, 0}) - glm::dvec3(-1, -1, 1)), 1e-14);
}

TEST(Directions, AreOfLengthOneAndTheOtherOneBelowABillionth) {
  for (const double length : {0.0, 0.9e-9, 1.1e-9, 3.0}) {
    EXPECT_EQ(UnitOr({0, -length, 0}, {1, 0, 0}), length > 1e-9 ? glm::dvec3(0, -1, 0) : glm::dvec3(1, 0, 0)) << length;
  }
}

TEST(UnitNormalPart, IsAtARightAngleToTheOneInThePlaneOfBoth) {
  const glm::dvec3 a = glm::normalize(glm::dvec3(1, -2, 0.5)), b(0.3, 0.7, -4), part = UnitNormalPart(b, a);
  EXPECT_NEAR(glm::dot(part, a), 0, 1e-12);
  EXPECT_NEAR(glm::length(part), 1, 1e-12);
  EXPECT_NEAR(glm::dot(part, glm::cross(a, b)), 0, 1e-12);
  EXPECT_GT(glm::dot(part, b), 0);
}

constexpr double kRounding = 1e-14;

/// Returns the Frobenius norm of a difference.
double Distance(const glm::dmat3& a, const glm::dmat3& b) {
  const glm::dmat3 d = a - b;
  return std::sqrt(glm::dot(d[0], d[0]) + glm::dot(d[1], d[1]) + glm::dot(d[2], d[2]));
}

glm::dmat3 Diagonal(double x, double y, double z) { return {x, 0, 0, 0, y, 0, 0, 0, z}; }

// The polar factor of R · S is R if S is symmetric and positive definite.
TEST(NearestRotation, IsThePolarFactorOfAStretchedRotation) {
  const glm::dmat3 R = RotationXyz({0.3, -1.1, 2.5}), axes = RotationXyz({-0.7, 0.2, 1.3});
  const glm::dmat3 stretch = axes * Diagonal(3, 2, 0.5) * glm::transpose(axes);
  const NearestRotation nearest = NearestRotationTo(R * stretch);
  EXPECT_LT(Distance(nearest.rotation, R), kRounding);
  EXPECT_LT(glm::length(nearest.signed_singular_values - glm::dvec3(3, 2, 0.5)), kRounding);
}

TEST(NearestRotation, OfAReflectionTurnsTheWeakestAxis) {
  const NearestRotation nearest = NearestRotationTo(Diagonal(3, 2, -0.5));
  EXPECT_LT(Distance(nearest.rotation, glm::dmat3(1)), kRounding);
  EXPECT_LT(glm::length(nearest.signed_singular_values - glm::dvec3(3, 2, -0.5)), kRounding);
}

// The squared distance between m and a rotation is |m|² + 3 − 2 · (the sum of the signed singular values) at its least.
TEST(NearestRotation, NoRotationOfAGridIsNearer) {
  const glm::dmat3 m(0.4, -1.2, 0.3, 0.9, 0.1, 0.8, 1.4, 0.2, -0.6);
  const NearestRotation nearest = NearestRotationTo(m);
  const glm::dvec3 values = nearest.signed_singular_values;
  const double least = Distance(m, nearest.rotation), size = Distance(m, glm::dmat3(0));
  EXPECT_NEAR(least * least, size * size + 3 - 2 * (values[0] + values[1] + values[2]), kRounding);
  EXPECT_NEAR(glm::determinant(nearest.rotation), 1, kRounding);
  for (double x = -3; x < 3; x += 0.5) {
    for (double y = -1.5; y < 1.5; y += 0.5) {
      for (double z = -3; z < 3; z += 0.5) EXPECT_GE(Distance(m, RotationXyz({x, y, z})), least);
    }
  }
}

}  // namespace
}  // namespace etude
