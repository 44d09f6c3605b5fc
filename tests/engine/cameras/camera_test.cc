#include "engine/cameras/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/results.h"

namespace etude {
namespace {

constexpr Distortion kLens{.k1 = -0.28, .k2 = 0.09, .p1 = 0.0012, .p2 = -0.0021, .k3 = -0.01};

// A second implementation, from the documentation of cv::projectPoints.
glm::dvec2 AsOpenCvSays(const Distortion& d, double x, double y) {
  const double r2 = x * x + y * y;
  const double radial = 1 + d.k1 * r2 + d.k2 * std::pow(r2, 2) + d.k3 * std::pow(r2, 3);
  return {x * radial + 2 * d.p1 * x * y + d.p2 * (r2 + 2 * x * x),
          y * radial + d.p1 * (r2 + 2 * y * y) + 2 * d.p2 * x * y};
}

TEST(Distortion, IsOpenCvsFormula) {
  for (double x = -0.6; x < 0.61; x += 0.1) {
    for (double y = -0.5; y < 0.51; y += 0.1) {
      const glm::dvec2 expected = AsOpenCvSays(kLens, x, y), found = Distort(kLens, {x, y});
      EXPECT_NEAR(found.x, expected.x, 1e-14);
      EXPECT_NEAR(found.y, expected.y, 1e-14);
    }
  }
  EXPECT_NE(Distort(kLens, {0.3, 0.2}), Distort({.k1 = -0.28, .k2 = 0.09, .p1 = -0.0021, .p2 = 0.0012}, {0.3, 0.2}));
}

TEST(Distortion, IsUndone) {
  for (double x = -0.6; x < 0.61; x += 0.05) {
    for (double y = -0.5; y < 0.51; y += 0.05) {
      ASSERT_OK(back, Undistort(kLens, Distort(kLens, {x, y})));
      EXPECT_NEAR(back->x, x, 1e-11);
      EXPECT_NEAR(back->y, y, 1e-11);
    }
  }
}

// On an axis without tangential terms r' = r + k r³, whose root has a closed form (Cardano).
TEST(Distortion, IsUndoneByTheCubicsOwnRoot) {
  for (const double k1 : {0.2, 0.5}) {
    for (const double seen : {0.1, 0.4, 0.7}) {
      const double p = 1 / k1, q = -seen / k1;
      const double root = std::sqrt(q * q / 4 + p * p * p / 27);
      const double exact = std::cbrt(-q / 2 + root) + std::cbrt(-q / 2 - root);
      EXPECT_NEAR(Undistort({.k1 = k1}, {seen, 0})->x, exact, 1e-12);
      EXPECT_NEAR(Undistort({.k1 = k1}, {0, -seen})->y, -exact, 1e-12);
    }
  }
}

TEST(Distortion, HasNoInverseBeyondItsFold) {
  // r + k r³ with k = −0.3 is largest at r = 1.054, where it is 0.7027.
  EXPECT_TRUE(Undistort({.k1 = -0.3}, {0.70, 0}));
  EXPECT_FALSE(Undistort({.k1 = -0.3}, {0.71, 0}));
  EXPECT_FALSE(Undistort({.k1 = -0.3}, {NAN, 0}));
}

TEST(Distortion, OfNothingLeavesEveryBit) {
  EXPECT_EQ(Distort({}, {0.1234567, -0.7654321}), glm::dvec2(0.1234567, -0.7654321));
  EXPECT_EQ(*Undistort({}, {0.1234567, -0.7654321}), glm::dvec2(0.1234567, -0.7654321));
}

TEST(Distortion, OfACameraMovesItsPixels) {
  Camera camera = LookAt({.fx = 610, .fy = 590, .cx = 318, .cy = 243, .skew = 2}, {1, 1.5, 3}, {0, 1, 0});
  const glm::dvec3 point(0.6, 1.7, -0.2);
  EXPECT_EQ(*Project(camera, point), *Project(MatrixOf(camera), point)) << "a pinhole, to the last bit";
  camera.distortion = kLens;
  const glm::dvec2 straight = *Project(MatrixOf(camera), point), seen = *Project(camera, point);
  EXPECT_GT(glm::length(straight - seen), 2);
  // A second implementation: K times the distorted ray in the camera's frame.
  const glm::dvec3 ray = camera.R_CW * (point - camera.p_WC);
  const glm::dvec2 bent = AsOpenCvSays(kLens, ray.x / ray.z, ray.y / ray.z);
  EXPECT_NEAR(seen.x, 610 * bent.x + 2 * bent.y + 318, 1e-9);
  EXPECT_NEAR(seen.y, 590 * bent.y + 243, 1e-9);
  const glm::dvec2 back = *UndistortPixel(camera, seen);
  EXPECT_NEAR(back.x, straight.x, 1e-8);
  EXPECT_NEAR(back.y, straight.y, 1e-8);
}

TEST(Distortion, HidesWhatALensWouldFoldBackIntoThePicture) {
  Camera camera = LookAt({}, {0, 1, 4}, {0, 1, 0});
  camera.distortion = {.k1 = -0.3};
  EXPECT_TRUE(Project(camera, {2, 1, 0}));
  EXPECT_FALSE(Project(camera, {7, 1, 0})) << "60 degrees aside: the model turns back at 46";
  EXPECT_TRUE(Project(MatrixOf(camera), {7, 1, 0}));
}

TEST(Camera, ShowsItsTargetAtThePrincipalPoint) {
  const Camera camera = LookAt({}, {3, 1.4, 2}, {0.2, 0.9, -0.1});
  ASSERT_OK(pixel, Project(MatrixOf(camera), {0.2, 0.9, -0.1}));
  EXPECT_NEAR(pixel->x, 320, 1e-9);
  EXPECT_NEAR(pixel->y, 240, 1e-9);
}

TEST(Camera, ShowsWhatIsHigherFurtherUpAndWhatIsToItsRightFurtherRight) {
  // From +Z towards the origin, +X is on the right: 600 px · 0.5 m / 4 m = 75 px.
  const ProjectionMatrix matrix = MatrixOf(LookAt({}, {0, 1, 4}, {0, 1, 0}));
  EXPECT_NEAR(Project(matrix, {0.5, 1, 0})->x, 320 + 75, 1e-9);
  EXPECT_NEAR(Project(matrix, {0, 1.5, 0})->y, 240 - 75, 1e-9);
}

TEST(Camera, LooksThroughTheMiddleOfItsPictureUnlessToldOtherwise) {
  const Intrinsics in;
  EXPECT_EQ(in.cx, in.width / 2.0);
  EXPECT_EQ(in.cy, in.height / 2.0);
  EXPECT_EQ(in.fx, in.fy) << "square pixels";
}

TEST(Camera, HasARotationInsideNotAReflection) {
  const Camera camera = LookAt({}, {-2, 1.5, 3}, {0, 1, 0});
  EXPECT_NEAR(glm::determinant(camera.R_CW), 1, 1e-12);
  const glm::dmat3 product = camera.R_CW * glm::transpose(camera.R_CW);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(product[i][j], i == j ? 1 : 0, 1e-12);
  }
}

TEST(Camera, SeesNothingBehindItOrInItsPlane) {
  const ProjectionMatrix matrix = MatrixOf(LookAt({}, {0, 1, 4}, {0, 1, 0}));
  EXPECT_FALSE(Project(matrix, {0, 1, 5}));
  EXPECT_FALSE(Project(matrix, {0.3, 1.2, 4}));
  EXPECT_FALSE(Project(matrix, {0, std::numeric_limits<double>::quiet_NaN(), 0}));
}

TEST(Camera, SkewMovesAPixelByItsHeight) {
  const ProjectionMatrix matrix = MatrixOf(LookAt({.skew = 40}, {0, 1, 4}, {0, 1, 0}));
  // u = fx·x + skew·y + cx with y = −0.5 m / 4 m.
  EXPECT_NEAR(Project(matrix, {0, 1.5, 0})->x, 320 - 40 * 0.125, 1e-9);
}

TEST(Distortion, OfMoreCoefficientsAndFisheyesIsUndone) {
  const Distortion all{.k1 = -0.12,
                       .k2 = 0.05,
                       .p1 = 0.001,
                       .p2 = -0.0015,
                       .k3 = 0.01,
                       .k4 = 0.02,
                       .k5 = -0.01,
                       .k6 = 0.004,
                       .s1 = 0.002,
                       .s2 = -0.001,
                       .s3 = 0.001,
                       .s4 = 0.0005,
                       .tau_x = 0.01,
                       .tau_y = -0.02};
  const Distortion fisheye{.k1 = -0.02, .k2 = 0.004, .k3 = -0.001, .k4 = 0.0003, .is_fisheye = true};
  for (const Distortion& d : {all, fisheye, Distortion{.is_fisheye = true}}) {
    for (const glm::dvec2 ray : {glm::dvec2(0, 0), {0.3, -0.2}, {-0.5, 0.4}, {0.01, 0.6}}) {
      ASSERT_OK(back, Undistort(d, Distort(d, ray)));
      EXPECT_LT(glm::distance(*back, ray), 1e-9);
    }
  }
  // A fisheye without coefficients shows angles: 45° is at π/4.
  EXPECT_NEAR(Distort({.is_fisheye = true}, {1, 0}).x, 0.78539816339744831, 1e-15);
  EXPECT_FALSE(Undistort({.is_fisheye = true}, {1.6, 0})) << "behind the camera";
  // A rational model with equal numerator and denominator distorts nothing.
  const Distortion equal{.k1 = 0.1, .k2 = 0.02, .k3 = 0.01, .k4 = 0.1, .k5 = 0.02, .k6 = 0.01};
  EXPECT_LT(glm::distance(Distort(equal, {0.4, 0.3}), glm::dvec2(0.4, 0.3)), 1e-15);
}

}  // namespace
}  // namespace etude
