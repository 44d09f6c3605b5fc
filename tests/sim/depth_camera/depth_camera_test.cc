#include "sim/depth_camera/depth_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

namespace etude {
namespace {

constexpr int kDepthWidth = 320, kDepthHeight = 240;
constexpr double kFocus = 580, kBaseline = 0.075;

Camera ACamera() {
  return LookAt({.width = kDepthWidth, .height = kDepthHeight, .fx = kFocus, .fy = kFocus, .cx = 160, .cy = 120},
                {0, 1, 3}, {0, 1, 0});
}

DepthImage Flat(double z) { return DepthImage(kDepthWidth, kDepthHeight, static_cast<float>(z)); }

/// Returns a near surface in the columns from 200 on, and a far one in the others.
DepthImage StepEdge(double near, double far) {
  DepthImage depth = Flat(far);
  for (int y = 0; y < kDepthHeight; ++y) {
    for (int x = 200; x < kDepthWidth; ++x) depth.At(x, y) = static_cast<float>(near);
  }
  return depth;
}

/// Returns a wall turned by `angle` about the vertical axis through the middle, where its depth is `z`.
DepthImage TurnedWall(double z, double angle) {
  DepthImage depth(kDepthWidth, kDepthHeight);
  for (int y = 0; y < kDepthHeight; ++y) {
    for (int x = 0; x < kDepthWidth; ++x) {
      depth.At(x, y) = static_cast<float>(z / (1 - std::tan(angle) * (x + 0.5 - 160) / kFocus));
    }
  }
  return depth;
}

/// Returns the same camera with every strength set to `strength`.
DepthCameraOptions WithStrength(DepthCameraOptions options, double strength) {
  options.axial_noise = options.lateral_noise = options.steps = strength;
  options.shadows = options.range = options.grazing = strength;
  return options;
}

/// Makes a camera of a kind with a single fault of strength 1.
DepthCameraOptions Only(const DepthCameraOptions& kind, double DepthCameraOptions::*fault) {
  DepthCameraOptions options = WithStrength(kind, 0);
  options.*fault = 1;
  return options;
}

DepthImage Measure(const DepthImage& truth, const DepthCameraOptions& options, int trial = 0) {
  RandomStream random({7, "depth-camera", trial}, "pixels");
  return MeasureDepth(truth, ACamera(), options, random);
}

bool SameBytes(const DepthImage& a, const DepthImage& b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)) == 0;
}

double DeviationFrom(double z, const DepthImage& measured) {
  double squares = 0;
  for (const float metres : measured.pixels) squares += (metres - z) * (metres - z);
  return std::sqrt(squares / static_cast<double>(measured.pixels.size()));
}

struct Line {
  double constant, slope;
};

Line Regress(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {(sy - slope * sx) / n, slope};
}

/// Fits the deviations of flat walls against (z − 0.4)².
Line AxialLaw(const DepthCameraOptions& options) {
  std::vector<double> squares, deviations;
  for (double z = 1; z < 3.8; z += 0.2) {
    squares.push_back((z - 0.4) * (z - 0.4));
    deviations.push_back(DeviationFrom(z, Measure(Flat(z), options)));
  }
  return Regress(squares, deviations);
}

TEST(DepthCamera, WithoutStrengthGivesTheTruthByteForByte) {
  DepthImage truth = TurnedWall(3, 1.2);
  truth.At(5, 5) = kNotMeasured;
  truth.At(100, 100) = 0.11f;
  truth.At(101, 100) = 17.3f;
  for (const DepthCameraOptions& kind : {KinectV1Depth(), KinectV1Depth(true), KinectV2Depth()}) {
    EXPECT_TRUE(SameBytes(Measure(truth, WithStrength(kind, 0)), truth));
    EXPECT_FALSE(SameBytes(Measure(truth, WithStrength(kind, 0.01)), truth)) << "a hundredth is seen";
  }
}

TEST(DepthCamera, AxialNoiseOfStructuredLightGrowsAsPublished) {
  const Line noise_alone = AxialLaw(Only(KinectV1Depth(), &DepthCameraOptions::axial_noise));
  EXPECT_NEAR(noise_alone.constant, 0.0012, 4e-5);
  EXPECT_NEAR(noise_alone.slope, 0.0019, 2e-5);
  const Line whole = AxialLaw(KinectV1Depth());
  EXPECT_NEAR(whole.constant, 0.0012, 1.2e-4) << "the steps' share is not added twice";
  EXPECT_NEAR(whole.slope, 0.0019, 4e-5);
  DepthCameraOptions twice = Only(KinectV1Depth(), &DepthCameraOptions::axial_noise);
  twice.axial_noise = 2;
  EXPECT_NEAR(AxialLaw(twice).slope, 0.0038, 4e-5) << "a strength multiplies";
}

TEST(DepthCamera, AxialNoiseOfTimeOfFlightGrowsAsPublished) {
  for (const double z : {0.8, 1.5, 2.5, 3.5, 4.4}) {
    const double law = 0.001 * (1.5 - 0.5 * z + 0.3 * z * z);
    EXPECT_NEAR(DeviationFrom(z, Measure(Flat(z), KinectV2Depth())) / law, 1, 0.01) << z;
    EXPECT_GT(std::abs(DeviationFrom(z, Measure(Flat(z), KinectV1Depth())) / law - 1), 0.05) << "not the other law";
  }
}

TEST(DepthCamera, StepsAreEighthsOfADisparity) {
  DepthImage truth = Flat(1);
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) truth.pixels[i] = 1 + 2.5f * i / truth.pixels.size();
  const DepthImage measured = Measure(truth, Only(KinectV1Depth(), &DepthCameraOptions::steps));
  const std::set<float> distinct(measured.pixels.begin(), measured.pixels.end());
  ASSERT_GT(distinct.size(), 200u);
  for (auto it = distinct.begin(), next = std::next(it); next != distinct.end(); ++it, ++next) {
    const double z = std::sqrt(static_cast<double>(*it) * *next);
    ASSERT_NEAR((*next - *it) / (z * z / (8 * kFocus * kBaseline)), 1, 1e-4) << z;
  }
  for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
    const double z = truth.pixels[i];
    ASSERT_LE(std::abs(measured.pixels[i] - z), 0.51 * z * z / (8 * kFocus * kBaseline)) << "the nearest step";
  }
}

TEST(DepthCamera, MeasuresWithinItsRangeOnly) {
  struct Case {
    DepthCameraOptions kind;
    double near, far;
  };
  for (const auto& [kind, near, far] :
       {Case{KinectV1Depth(), 0.8, 4.0}, Case{KinectV1Depth(true), 0.4, 3.0}, Case{KinectV2Depth(), 0.5, 4.5}}) {
    DepthCameraOptions options = Only(kind, &DepthCameraOptions::range);
    for (const double z : {near + 0.001, (near + far) / 2, far - 0.001}) {
      EXPECT_TRUE(SameBytes(Measure(Flat(z), options), Flat(z))) << z;
    }
    for (const double z : {near - 0.001, far + 0.001, 20.0}) {
      EXPECT_TRUE(SameBytes(Measure(Flat(z), options), Flat(kNotMeasured))) << z;
    }
    options.range = 0.5;
    for (const double z : {near / 2 + 0.001, 2 * far - 0.001})
      EXPECT_TRUE(SameBytes(Measure(Flat(z), options), Flat(z)));
  }
}

TEST(DepthCamera, WhatIsSeenAtASlantIsLost) {
  const DepthCameraOptions options = Only(KinectV1Depth(), &DepthCameraOptions::grazing);
  // The angle between a ray and the wall's normal is the wall's turn minus or plus the ray's angle to the axis.
  const auto lost_at = [&](double degrees, double strength) {
    DepthCameraOptions weaker = options;
    weaker.grazing = strength;
    const double turn = degrees * std::numbers::pi / 180;
    return std::isinf(Measure(TurnedWall(2, turn), weaker).At(160, 120));
  };
  EXPECT_FALSE(lost_at(0, 1));
  EXPECT_FALSE(lost_at(79, 1));
  EXPECT_TRUE(lost_at(81, 1));
  EXPECT_FALSE(lost_at(84, 0.5));
  EXPECT_TRUE(lost_at(86, 0.5)) << "half of the way to a right angle";
  EXPECT_FALSE(lost_at(86, 0));
}

/// Returns the share that measures the near surface, among the pixels of the far surface that are `pixels_away` from
/// an edge; 0 = next to the edge.
double ShareOfNear(const DepthCameraOptions& options, int pixels_away) {
  int shown = 0, all = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const DepthImage measured = Measure(StepEdge(1.5, 3), options, trial);
    for (int y = 10; y < kDepthHeight - 10; ++y, ++all) shown += measured.At(199 - pixels_away, y) < 2;
  }
  return static_cast<double>(shown) / all;
}

TEST(DepthCamera, EdgesAreAsUnsteadyAsPublished) {
  const DepthCameraOptions options = Only(KinectV1Depth(), &DepthCameraOptions::lateral_noise);
  for (const int away : {0, 1, 2}) {
    const double angle = std::atan((160 - (199.5 - away)) / kFocus);
    const double sigma = 0.8 + 0.035 * std::abs(angle) / (std::numbers::pi / 2 - std::abs(angle));
    const double share = 0.5 * std::erfc((away + 0.5) / sigma / std::numbers::sqrt2);
    EXPECT_NEAR(ShareOfNear(options, away), share, 4 * std::sqrt(share * (1 - share) / 1760)) << away;
    DepthCameraOptions twice = options;
    twice.lateral_noise = 2;
    EXPECT_GT(ShareOfNear(twice, away), share + 4 * std::sqrt(share * (1 - share) / 1760)) << "the test would see it";
  }
  EXPECT_NEAR(LateralDeviationPx(0), 0.8, 1e-12);
  EXPECT_NEAR(LateralDeviationPx(std::numbers::pi / 4), 0.835, 1e-12);
  EXPECT_TRUE(SameBytes(Measure(TurnedWall(2, 0.9), options), TurnedWall(2, 0.9))) << "no edge, no shift";
}

TEST(DepthCamera, EdgesShiftInBothDirectionsByPixelsOfTheSensor) {
  DepthImage corner = Flat(3);
  for (int y = 120; y < kDepthHeight; ++y) {
    for (int x = 160; x < kDepthWidth; ++x) corner.At(x, y) = 1.5f;
  }
  const DepthCameraOptions options = Only(KinectV2Depth(), &DepthCameraOptions::lateral_noise);
  const int trials = 60, pixels = 100 * trials;
  int above = 0, beside = 0, diagonal = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const DepthImage measured = Measure(corner, options, trial);
    for (int i = 0; i < 100; ++i) above += measured.At(200 + i, 119) < 2, beside += measured.At(159, 130 + i) < 2;
    diagonal += measured.At(159, 119) < 2;
  }
  // The picture's focal length is 580 px, the sensor's 365 px.
  const double share = 0.5 * std::erfc(0.5 / (0.8 * 580 / 365) / std::numbers::sqrt2);
  const double both = share * share;
  EXPECT_NEAR(static_cast<double>(above) / pixels, share, 4 * std::sqrt(share * (1 - share) / pixels));
  EXPECT_NEAR(static_cast<double>(beside) / pixels, share, 4 * std::sqrt(share * (1 - share) / pixels));
  EXPECT_NEAR(static_cast<double>(diagonal) / trials, both, 4 * std::sqrt(both * (1 - both) / trials))
      << "a throw for each direction";
}

TEST(DepthCamera, StrengthsDoNotChangeTheDice) {
  const auto next = [](const DepthCameraOptions& options, const DepthImage& truth) {
    RandomStream random({7, "depth-camera", 0}, "pixels");
    MeasureDepth(truth, ACamera(), options, random);
    return random.Bits();
  };
  const std::uint64_t expected = next(KinectV1Depth(), Flat(2));
  EXPECT_EQ(next(WithStrength(KinectV1Depth(), 0), Flat(2)), expected);
  EXPECT_EQ(next(KinectV2Depth(), StepEdge(1, 3)), expected);
  EXPECT_EQ(next(KinectV1Depth(), Flat(kNotMeasured)), expected);
  EXPECT_NE(next(KinectV1Depth(), DepthImage(kDepthWidth, kDepthHeight - 1, 2)), expected)
      << "fewer pixels, fewer throws";
  // Half the strength halves each pixel's error.
  DepthCameraOptions half = Only(KinectV1Depth(), &DepthCameraOptions::axial_noise), whole = half;
  half.axial_noise = 0.5;
  const DepthImage a = Measure(Flat(2), half), b = Measure(Flat(2), whole);
  for (std::size_t i = 0; i < a.pixels.size(); ++i) ASSERT_NEAR(2 * (a.pixels[i] - 2), b.pixels[i] - 2, 1e-6);
}

constexpr int kColumns = 400, kRows = 4;
constexpr double kFocusPx = 580, kBaselineM = 0.075;

Camera FewRows(double focus = kFocusPx) {
  return LookAt({.width = kColumns, .height = kRows, .fx = focus, .fy = focus, .cx = 200, .cy = 2}, {0, 1, 3},
                {0, 1, 0});
}

/// Returns a near strip of columns `from` to `to` − 1 in front of a far wall.
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
  // The strip touches the picture's left border; at its right edge the projector sees more than the camera.
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

// A second implementation: rays from the projector to the wall, against a disc (a pillar from above).
TEST(ProjectorShadow, OfAPillarIsWhereRaysFromTheProjectorMeetIt) {
  const double middle_x = 0.1, middle_z = 1.5, radius = 0.12, wall = 3;
  const auto meets = [&](double from_x, double to_x, double to_z) -> double {
    const double dx = to_x - from_x, dz = to_z, fx = from_x - middle_x, fz = -middle_z;
    const double a = dx * dx + dz * dz, b = dx * fx + dz * fz, c = fx * fx + fz * fz - radius * radius;
    return b * b < a * c ? 2 : (-b - std::sqrt(b * b - a * c)) / a;  // share of the ray's length
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
