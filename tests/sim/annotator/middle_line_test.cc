#include "engine/vision/limb_regions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/angles.h"
#include "tests/sim/annotator/annotated_body.h"

namespace etude {
namespace {

MiddleLine LineOf(const std::vector<Capsule>& body, const Camera& camera, Part part) {
  const Shown shown(LabelsOf(body, camera));
  const Regions regions = FindRegions(shown.labels, shown.colours, shown.person, 0);
  EXPECT_GT(regions[part].pixels, 0);
  return FindMiddleLine(regions[part]);
}

// A cylinder's outline is two planes through the camera that touch it, at equal angles to the plane through its axis:
// the middle between the two lines is off the axis's image by less than the difference of two tangents.
TEST(FindMiddleLine, OfACapsuleSeenWholeIsItsAxisToAPixelWithBothEnds) {
  const Camera camera = LookAt({}, {0.3, 1.2, 3.5}, {0, 1, 0});
  const ProjectionMatrix matrix = MatrixOf(camera);
  int checked = 0;
  for (int turn = 0; turn < 18; ++turn) {
    for (const double towards_camera : {0.0, 0.15, -0.15}) {
      const double angle = Radians(10.0 * turn + 3);
      const glm::dvec3 half(0.22 * std::cos(angle), 0.22 * std::sin(angle), towards_camera);
      const Capsule limb{Part::kLeftThigh, glm::dvec3(0.1, 1, 0) - half, glm::dvec3(0.1, 1, 0) + half, 0.06};
      const MiddleLine line = LineOf({limb}, camera, Part::kLeftThigh);
      glm::dvec2 a = *Project(matrix, limb.a), b = *Project(matrix, limb.b);
      if (glm::dot(b - a, line.along) < 0) std::swap(a, b);
      const PixelSegment found{line.At(line.low + line.half_width), line.At(line.high - line.half_width)};
      EXPECT_LT(LineDistance(a, found), 1) << turn;
      EXPECT_LT(LineDistance(b, found), 1) << turn;
      // A ball nearer to the camera is larger than the limb's usual width, one farther away smaller: the ends' bias.
      const double bias = towards_camera == 0 ? 1 : 1.6;
      EXPECT_LT(glm::distance(found.a, a), bias) << turn;
      EXPECT_LT(glm::distance(found.b, b), bias) << turn;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 54);
}

TEST(FindMiddleLine, StaysInTheMiddleOfALimbWhoseEndIsCutOffAslant) {
  LabelImage labels(200, 100);
  for (int y = 40; y < 60; ++y) {
    for (int x = 20 + (y - 40); x < 150; ++x) labels.At(x, y) = static_cast<std::uint32_t>(Part::kLeftShank);
  }
  const Shown shown(labels);
  const Regions regions = FindRegions(shown.labels, shown.colours, shown.person, 0);
  const MiddleLine line = FindMiddleLine(regions[Part::kLeftShank]);
  EXPECT_NEAR(std::abs(line.along.x), 1, 1e-4);
  EXPECT_NEAR(line.At(0).y, 50, 0.3);
  EXPECT_NEAR(line.half_width, 10, 0.5);
  EXPECT_TRUE(line.IsLong());
}

TEST(FindMiddleLine, OfADiscHasNoDirectionOfItsOwn) {
  const Capsule ball{Part::kHead, {0, 1, 0}, {0, 1, 0}, 0.1};
  EXPECT_FALSE(LineOf({ball}, FrontCamera(), Part::kHead).IsLong());
}

TEST(FindMiddleLine, OfASinglePixelIsThatPixel) {
  LabelImage labels(5, 5);
  labels.At(3, 1) = static_cast<std::uint32_t>(Part::kHead);
  const Shown shown(labels);
  const MiddleLine line = FindMiddleLine(FindRegions(shown.labels, shown.colours, shown.person, 0)[Part::kHead]);
  EXPECT_EQ(line.origin, glm::dvec2(3.5, 1.5));
  EXPECT_EQ(line.half_width, 0.5);
  EXPECT_EQ(line.high - line.low, 1);
}

}  // namespace
}  // namespace etude
