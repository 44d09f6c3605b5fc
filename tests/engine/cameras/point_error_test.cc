#include "engine/cameras/point_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/base/angles.h"
#include "engine/cameras/robust_triangulation.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

RandomStream Dice(int trial) { return {WorldKey{Seed{1}, "point-error", trial}, "draws"}; }

/// Returns two to four cameras at random angles, heights and distances, some with a lens.
std::vector<Camera> RandomRig(RandomStream& dice) {
  std::vector<Camera> cameras;
  const int count = 2 + static_cast<int>(dice.IndexBelow(3));
  const double first = dice.Uniform(0, 2 * kPi);
  for (int i = 0; i < count; ++i) {
    const double angle = first + i * dice.Uniform(0.8, 1.4), distance = dice.Uniform(3, 5);
    const glm::dvec3 place(distance * std::sin(angle), dice.Uniform(0.6, 2.6), distance * std::cos(angle));
    const double focal = dice.Uniform(500, 800);
    Camera camera =
        LookAt({.width = 1280, .height = 960, .fx = focal, .fy = focal, .cx = 640, .cy = 480}, place, {0, 1, 0});
    if (dice.Chance(0.5)) camera.distortion = {.k1 = -0.15, .k2 = 0.04, .p1 = 0.001};
    cameras.push_back(camera);
  }
  return cameras;
}

/// Returns the camera with random calibration errors of its rotation, position and focal length.
Camera Miscalibrated(Camera camera, const CalibrationDeviation& deviation, RandomStream& dice) {
  const glm::dvec3 turn = deviation.turn * dice.Normal3();
  const double angle = glm::length(turn);
  if (angle > 0) {
    const glm::dvec3 u = turn / angle;
    const glm::dmat3 cross(0, u.z, -u.y, -u.z, 0, u.x, u.y, -u.x, 0);  // its columns
    camera.R_CW = (glm::dmat3(1) + std::sin(angle) * cross + (1 - std::cos(angle)) * cross * cross) * camera.R_CW;
  }
  camera.p_WC += deviation.place_m * dice.Normal3();
  const double gain = 1 + deviation.focal * dice.Normal();
  camera.intrinsics.fx *= gain;
  camera.intrinsics.fy *= gain;
  return camera;
}

/// Returns the RMS error of `draws` simulated triangulations.
double SimulatedRms(const std::vector<Camera>& cameras, const glm::dvec3& p_WQ, const SightingErrors& errors, int draws,
                    RandomStream& dice) {
  double sum = 0;
  int measured = 0;
  for (int i = 0; i < draws; ++i) {
    std::vector<InformedSighting> sightings;
    for (const Camera& camera : cameras) {
      const Camera believed = Miscalibrated(camera, errors.calibration, dice);
      const glm::dvec2 noise = errors.noise_px * glm::dvec2(dice.Normal(), dice.Normal());
      if (!HasInPicture(camera, p_WQ) || dice.Chance(errors.dropout)) continue;
      if (const auto pixel = UndistortPixel(believed, *Project(camera, p_WQ) + noise))
        sightings.push_back({{MatrixOf(believed), *pixel}});
    }
    const auto point = sightings.size() < 2 ? std::nullopt : TriangulateLikeliest(sightings);
    if (!point) continue;
    ++measured;
    const glm::dvec3 off = point->position - p_WQ;
    sum += glm::dot(off, off);
  }
  return std::sqrt(sum / measured);
}

TEST(ExpectedPointError, IsThatOfSimulatedTriangulations) {
  const SightingErrors kinds[] = {{.noise_px = 3},
                                  {.noise_px = 2, .calibration = {.place_m = 0.01, .turn = 0.004, .focal = 0.005}},
                                  {.noise_px = 4, .dropout = 0.2, .calibration = {.place_m = 0.003}}};
  constexpr int kRigs = 20, kPlaces = 30, kDraws = 1200;
  int compared = 0, with_two = 0, beyond = 0;
  for (int rig = 0; rig < kRigs; ++rig) {
    RandomStream dice = Dice(rig);
    const std::vector<Camera> cameras = RandomRig(dice);
    for (int place = 0; place < kPlaces; ++place) {
      const glm::dvec3 p_WQ(dice.Uniform(-1.2, 1.2), dice.Uniform(0.05, 1.9), dice.Uniform(-1.2, 1.2));
      const SightingErrors& errors = kinds[place % 3];
      const PointError expected = ExpectedPointError(cameras, p_WQ, errors);
      if (expected.lost >= 1) continue;
      const double simulated = SimulatedRms(cameras, p_WQ, errors, kDraws, dice);
      const double ratio = expected.Rms() / simulated;
      EXPECT_TRUE(errors.dropout > 0 || std::abs(ratio - 1) < 0.15) << ratio << ": " << rig << ", " << place;
      beyond += std::abs(ratio - 1) > 0.15;
      ++compared;
      with_two += cameras.size() == 2;
    }
  }
  EXPECT_GT(compared, 500);
  EXPECT_GT(with_two, 60);
  // If only two cameras remain that nearly face each other, the error is too large for a first-order formula.
  EXPECT_LE(beyond, compared / 100);
}

TEST(ExpectedPointError, OfAStereoPairIsTheClosedForm) {
  // Two parallel cameras with base b, a point in the middle at depth Z: the deviation is σ Z² √2 / (f b) in depth and σ
  // Z / (f √2) in height, and the same sideways.
  const Intrinsics in{.width = 2000, .height = 2000, .fx = 1000, .fy = 1000, .cx = 1000, .cy = 1000};
  constexpr double kBase = 0.5, kDepth = 4, kNoise = 2;
  const glm::dvec3 forwards(0, 0, -1);
  const glm::dvec3 left(-kBase / 2, 1, 0), right(kBase / 2, 1, 0);
  const std::vector<Camera> cameras = {LookAt(in, left, left + forwards), LookAt(in, right, right + forwards)};
  const PointError error = ExpectedPointError(cameras, {0, 1, -kDepth}, {.noise_px = kNoise});
  EXPECT_EQ(error.cameras, 2);
  EXPECT_NEAR(std::sqrt(error.covariance[2][2]), kNoise * kDepth * kDepth * std::sqrt(2.0) / (1000 * kBase), 1e-4);
  EXPECT_NEAR(std::sqrt(error.covariance[1][1]), kNoise * kDepth / (1000 * std::sqrt(2.0)), 1e-9);
  EXPECT_EQ(error.covariance, error.noise);
}

TEST(ExpectedPointError, CountsEveryCombinationOfCameras) {
  std::vector<Camera> cameras;
  for (int i = 0; i < 3; ++i) {
    const double angle = 1.3 * i;
    cameras.push_back(LookAt({}, {4 * std::sin(angle), 1.5, 4 * std::cos(angle)}, {0, 1, 0}));
  }
  const glm::dvec3 p_WQ(0.1, 1, 0.2);
  const PointError error = ExpectedPointError(cameras, p_WQ, {.noise_px = 1, .dropout = 0.25});
  EXPECT_NEAR(error.lost, 1 - (0.75 * 0.75 * 0.75 + 3 * 0.75 * 0.75 * 0.25), 1e-12);
  EXPECT_GT(error.Rms(), ExpectedPointError(cameras, p_WQ, {.noise_px = 1}).Rms());
}

TEST(ExpectedPointError, IsNoneWhereTwoCamerasDoNotMeet) {
  const Camera one = LookAt({}, {0, 1, 4}, {0, 1, 0}), other = LookAt({}, {4, 1, 0}, {0, 1, 0});
  EXPECT_EQ(ExpectedPointError(std::vector{one}, {0, 1, 0}, {}).lost, 1);
  EXPECT_EQ(ExpectedPointError(std::vector{one, one}, {0, 1, 0}, {}).lost, 1) << "their lines of sight are one";
  EXPECT_EQ(ExpectedPointError(std::vector{one, other}, {0, 1, 8}, {}).lost, 1) << "behind a camera";
  EXPECT_EQ(ExpectedPointError(std::vector<Camera>{}, {0, 1, 0}, {}).lost, 1);
  EXPECT_LT(ExpectedPointError(std::vector{one, other}, {0, 1, 0}, {}).lost, 1e-12) << "the control";
}

}  // namespace
}  // namespace etude
