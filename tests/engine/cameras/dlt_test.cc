#include "engine/cameras/dlt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

ProjectionMatrix TrueMatrix() {
  return MatrixOf(LookAt({.fx = 610, .fy = 590, .skew = 3}, {2.2, 1.4, 3.1}, {0, 1, 0}));
}

// Returns the corners of a box, and random points inside.
std::vector<PointPair> Pairs(int count) {
  std::vector<PointPair> pairs;
  for (int i = 0; i < count; ++i) {
    const double t = i;
    const glm::dvec3 world(std::sin(1.7 * t), 1 + std::cos(2.3 * t), std::sin(0.9 * t + 1));
    pairs.push_back({world, *Project(TrueMatrix(), world)});
  }
  return pairs;
}

std::vector<PointPair> WithPixelErrors(std::vector<PointPair> pairs, double size_px) {
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double t = static_cast<double>(i);
    pairs[i].pixel += size_px * glm::dvec2(std::sin(37 * t), std::cos(91 * t));
  }
  return pairs;
}

class Dlt : public ::testing::TestWithParam<Calibration> {};

TEST_P(Dlt, GivesTheMatrixBackFromSixExactPairs) {
  ASSERT_OK(matrix, Calibrate(Pairs(6), GetParam()));
  // MatrixOf has the same scale: its third row is a unit vector, so w is the depth.
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      EXPECT_NEAR(matrix->h[row][column], TrueMatrix().h[row][column], 1e-6) << row << ", " << column;
    }
  }
}

TEST_P(Dlt, LooksAtNoPairButThoseGiven) {
  std::vector<PointPair> pairs = Pairs(8);
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  pairs.front() = pairs.back() = {{kNaN, kNaN, kNaN}, {kNaN, kNaN}};
  ASSERT_OK(matrix, Calibrate(std::span<const PointPair>(pairs).subspan(1, 6), GetParam()));
  EXPECT_LT(ReprojectionRms(*matrix, Pairs(8)), 1e-3);
  EXPECT_FALSE(Calibrate(pairs, GetParam())) << "the control: those around them break everything";
}

TEST_P(Dlt, FitsNoisyPairsToAboutTheirNoise) {
  const auto noisy = WithPixelErrors(Pairs(30), 0.7);
  ASSERT_OK(matrix, Calibrate(noisy, GetParam()));
  EXPECT_LT(ReprojectionRms(*matrix, noisy), 0.8);
  EXPECT_GT(ReprojectionRms(*matrix, noisy), 0.4);
  EXPECT_LT(ReprojectionRms(*matrix, Pairs(30)), 0.5) << "more pairs average their noise away";
}

TEST_P(Dlt, RefusesFewerThanSixPairs) {
  EXPECT_THAT(testing::Message(Calibrate(Pairs(5), GetParam())), HasSubstr("5 point pairs"));
}

TEST_P(Dlt, RefusesPointsInOnePlane) {
  std::vector<PointPair> pairs = Pairs(12);
  for (PointPair& p : pairs) {
    p.world.y = 0.5 + 0.25 * p.world.x;
    p.pixel = *Project(TrueMatrix(), p.world);
  }
  EXPECT_THAT(testing::Message(Calibrate(WithPixelErrors(pairs, 0.5), GetParam())), HasSubstr("in one plane"));
}

TEST_P(Dlt, RefusesPointsOnOneLine) {
  std::vector<PointPair> pairs = Pairs(12);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pairs[i].world = glm::dvec3(0.1, 1, 0.2) + 0.1 * static_cast<double>(i) * glm::dvec3(1, 0.5, -0.3);
  }
  EXPECT_THAT(testing::Message(Calibrate(pairs, GetParam())), HasSubstr("on one line"));
}

TEST_P(Dlt, RefusesOnePointRepeated) { EXPECT_FALSE(Calibrate(std::vector<PointPair>(8, Pairs(1)[0]), GetParam())); }

TEST_P(Dlt, RefusesPairsThatNoCameraHasInFrontOfIt) {
  // Points on both sides of the camera's plane: the equations cannot tell w from −w.
  std::vector<PointPair> pairs = Pairs(10);
  const glm::dvec3 eye(2.2, 1.4, 3.1);
  for (std::size_t i = 5; i < pairs.size(); ++i) pairs[i].world = 2.0 * eye - pairs[i].world;  // same ray, behind
  EXPECT_THAT(testing::Message(Calibrate(pairs, GetParam())), HasSubstr("behind the camera"));
}

TEST_P(Dlt, RefusesNumbersThatAreNotFinite) {
  std::vector<PointPair> pairs = Pairs(8);
  pairs[2].pixel.x = std::numeric_limits<double>::quiet_NaN();
  auto matrix = Calibrate(pairs, GetParam());
  EXPECT_THAT(testing::Message(matrix), HasSubstr("point pair 3 has a coordinate that is not finite"));
  pairs = Pairs(8);
  pairs[7].world.z = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(Calibrate(pairs, GetParam()));
}

TEST_P(Dlt, RefusesPairsThatManyCamerasFit) {
  // All points but one lie in a plane, so they give 8 + 2 independent equations for the 11 unknowns of the matrix.
  std::vector<PointPair> pairs = Pairs(10);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    pairs[i].world.y = 0.5;
    pairs[i].pixel = *Project(TrueMatrix(), pairs[i].world);
  }
  EXPECT_THAT(testing::Message(Calibrate(pairs, GetParam())), HasSubstr("several different cameras fit"));
}

INSTANTIATE_TEST_SUITE_P(BothWays, Dlt, ::testing::Values(Calibration::kDlt, Calibration::kDltNormalised),
                         [](const auto& which) { return which.param == Calibration::kDlt ? "plain" : "normalised"; });

TEST(ReprojectionRms, IsZeroForTheTrueMatrixAndTheShiftForAShiftedOne) {
  EXPECT_NEAR(ReprojectionRms(TrueMatrix(), Pairs(9)), 0, 1e-9);
  std::vector<PointPair> shifted = Pairs(9);
  for (PointPair& p : shifted) p.pixel += glm::dvec2(3, 4);
  EXPECT_NEAR(ReprojectionRms(TrueMatrix(), shifted), 5, 1e-9);
}

}  // namespace
}  // namespace etude
