#include "engine/cameras/camera.h"

#include <gtest/gtest.h>

#include <limits>

namespace etude {
namespace {

TEST(Camera, ShowsItsTargetAtThePrincipalPoint) {
  const Camera camera = LookAt({}, {3, 1.4, 2}, {0.2, 0.9, -0.1});
  const auto pixel = Project(MatrixOf(camera), {0.2, 0.9, -0.1});
  ASSERT_TRUE(pixel);
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
  Intrinsics skewed;
  skewed.skew = 40;
  const ProjectionMatrix matrix = MatrixOf(LookAt(skewed, {0, 1, 4}, {0, 1, 0}));
  // u = fx·x + skew·y + cx with y = −0.5 m / 4 m.
  EXPECT_NEAR(Project(matrix, {0, 1.5, 0})->x, 320 - 40 * 0.125, 1e-9);
}

}  // namespace
}  // namespace etude
