#include "sim/depth_camera/projector_shadow.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "sim/depth_camera/depth_camera.h"

namespace etude {
namespace {

constexpr int kColumns = 400, kRows = 4;
constexpr double kFocusPx = 580, kBaselineM = 0.075;

Camera FewRows(double focus = kFocusPx) {
  return LookAt({.width = kColumns, .height = kRows, .fx = focus, .fy = focus, .cx = 200, .cy = 2}, {0, 1, 3},
                {0, 1, 0});
}

/// A near strip from column `from` to `to` − 1 before a far wall.
DepthImage Strip(double near, double far, int from, int to) {
  DepthImage depth(kColumns, kRows, static_cast<float>(far));
  for (int y = 0; y < kRows; ++y) {
    for (int x = from; x < to; ++x) depth.At(x, y) = static_cast<float>(near);
  }
  return depth;
}

int Count(const Mask& mask, int y) {
  const auto row = mask.pixels.begin() + static_cast<std::ptrdiff_t>(y) * mask.width;
  return std::accumulate(row, row + mask.width, 0);
}

TEST(ProjectorShadow, OfAnEdgeIsAsWideAsTheDisparitiesDiffer) {
  for (const double near : {0.8, 1.0, 1.7, 2.5}) {
    for (const double far : {2.8, 3.3, 4.0}) {
      const double width = kFocusPx * kBaselineM * (1 / near - 1 / far);
      const Mask unlit = ProjectorShadow(Strip(near, far, 200, kColumns), FewRows(), kBaselineM);
      for (int y = 0; y < kRows; ++y) EXPECT_NEAR(Count(unlit, y), width, 0.501) << near << " before " << far;
      EXPECT_TRUE(unlit.At(199, 0)) << "it touches the edge";
      EXPECT_FALSE(unlit.At(199 - static_cast<int>(width + 1), 0));
      EXPECT_FALSE(unlit.At(200, 0)) << "what is near is lit";
    }
  }
  EXPECT_NEAR(Count(ProjectorShadow(Strip(1, 4, 200, kColumns), FewRows(2 * kFocusPx), kBaselineM), 0),
              2 * kFocusPx * kBaselineM * 0.75, 0.501)
      << "in the camera's own pixels";
}

TEST(ProjectorShadow, FallsToTheLeftOnly) {
  // The strip reaches the picture's left border: behind its right edge the projector sees more than the camera.
  EXPECT_EQ(Count(ProjectorShadow(Strip(1, 4, 0, 200), FewRows(), kBaselineM), 0), 0);
}

TEST(ProjectorShadow, OfAThinThingStandsApartFromIt) {
  const double shift = kFocusPx * kBaselineM * (1 - 1.0 / 3);  // 29 pixels
  const Mask unlit = ProjectorShadow(Strip(1, 3, 200, 206), FewRows(), kBaselineM);
  EXPECT_NEAR(Count(unlit, 0), 6, 1) << "as wide as the thing";
  EXPECT_TRUE(unlit.At(static_cast<int>(203 - shift), 0));
  EXPECT_FALSE(unlit.At(198, 0)) << "beside the thing light passes behind it";
}

TEST(ProjectorShadow, NeedsABaselineAndAnEdge) {
  EXPECT_EQ(Count(ProjectorShadow(Strip(1, 3, 200, 300), FewRows(), 0), 0), 0);
  EXPECT_EQ(Count(ProjectorShadow(Strip(1, 1, 200, 300), FewRows(), kBaselineM), 0), 0);
  DepthImage slanted(kColumns, kRows);
  for (int y = 0; y < kRows; ++y) {
    for (int x = 0; x < kColumns; ++x) slanted.At(x, y) = static_cast<float>(1.5 / (1 - 1.2 * (x - 200) / kFocusPx));
  }
  EXPECT_EQ(Count(ProjectorShadow(slanted, FewRows(), kBaselineM), 0), 0) << "a wall does not shade itself";
  const float nothing = std::numeric_limits<float>::infinity();
  EXPECT_EQ(Count(ProjectorShadow(Strip(1, nothing, 200, 300), FewRows(), kBaselineM), 0), 0)
      << "nothing is there to shade";
}

// A second way to the same: rays from the projector to points of the wall against a disc (a pillar seen from above).
TEST(ProjectorShadow, OfAPillarIsWhereRaysFromTheProjectorMeetIt) {
  const double middle_x = 0.1, middle_z = 1.5, radius = 0.12, wall = 3;
  const auto meets = [&](double from_x, double to_x, double to_z) -> double {
    const double dx = to_x - from_x, dz = to_z, fx = from_x - middle_x, fz = -middle_z;
    const double a = dx * dx + dz * dz, b = dx * fx + dz * fz, c = fx * fx + fz * fz - radius * radius;
    return b * b < a * c ? 2 : (-b - std::sqrt(b * b - a * c)) / a;  // as a share of the way
  };
  DepthImage depth(kColumns, kRows);
  for (int y = 0; y < kRows; ++y) {
    for (int x = 0; x < kColumns; ++x) {
      const double across = (x + 0.5 - 200) / kFocusPx;
      depth.At(x, y) = static_cast<float>(wall * std::min(1.0, meets(0, across * wall, wall)));
    }
  }
  const Mask unlit = ProjectorShadow(depth, FewRows(), kBaselineM);
  int differing = 0, shaded = 0;
  for (int x = 0; x < kColumns; ++x) {
    const double z = depth.At(x, 0), across = (x + 0.5 - 200) / kFocusPx;
    const bool expected = meets(kBaselineM, across * z, z) < 1 - 1e-6;
    shaded += expected;
    differing += expected != static_cast<bool>(unlit.At(x, 0));
  }
  EXPECT_GT(shaded, 10);
  EXPECT_LE(differing, 2) << "the shadow's two borders, to a pixel";
}

TEST(ProjectorShadow, IsAHoleInTheMeasuredPicture) {
  DepthCameraOptions options = WithStrength(KinectV1Depth(), 0);
  const DepthImage truth = Strip(1, 4, 200, kColumns);
  const auto holes = [&](double strength) {
    options.shadows = strength;
    RandomStream random({7, "depth-camera", 0}, "pixels");
    const DepthImage measured = MeasureDepth(truth, FewRows(), options, random);
    int count = 0;
    for (int x = 0; x < kColumns; ++x) count += std::isinf(measured.At(x, 1));
    return count;
  };
  EXPECT_NEAR(holes(1), kFocusPx * kBaselineM * 0.75, 0.501);
  EXPECT_NEAR(holes(0.5), kFocusPx * kBaselineM * 0.375, 0.501);
  EXPECT_EQ(holes(0), 0);
}

}  // namespace
}  // namespace etude
