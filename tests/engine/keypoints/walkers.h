#pragma once

#include <cmath>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/keypoints/keypoint_motion.h"
#include "sim/random/stream.h"

namespace etude {

/// Returns four cameras around the origin, with lens distortion.
inline std::vector<Camera> FourCameras() {
  const Intrinsics in{.width = 1280, .height = 720, .fx = 900, .fy = 900, .cx = 640, .cy = 360, .skew = 0};
  std::vector<Camera> cameras{LookAt(in, {0.3, 1.3, 4}, {0, 1, 0}), LookAt(in, {3.2, 2.1, 2.4}, {0, 1, 0}),
                              LookAt(in, {-3.4, 1.7, 1.8}, {0, 1, 0}), LookAt(in, {1.1, 2.4, -3.8}, {0, 1, 0})};
  for (Camera& camera : cameras) camera.distortion = {.k1 = -0.08, .k2 = 0.02, .p1 = 0.0005, .p2 = -0.0004};
  return cameras;
}

inline std::vector<ProjectionMatrix> MatricesOf(const std::vector<Camera>& cameras) {
  std::vector<ProjectionMatrix> matrices;
  for (const Camera& camera : cameras) matrices.push_back(MatrixOf(camera));
  return matrices;
}

inline std::vector<Camera> Pinholes() {
  std::vector<Camera> cameras = FourCameras();
  for (Camera& camera : cameras) camera.distortion = {};
  return cameras;
}

/// Returns a stick figure that walks on the spot at (x, 0, z) and swings its arms. It has every landmark but the hands
/// and the hips' middle. Its limbs keep their lengths: shank 0.42, thigh 0.43, upper arm 0.29, forearm 0.25 m.
inline LandmarkPositions Walker(double x, double z, double seconds) {
  using enum Landmark;
  LandmarkPositions marks;
  const glm::dvec3 hips(x, 0.92, z);
  const auto down = [](double angle) { return glm::dvec3(0, -std::cos(angle), std::sin(angle)); };
  const auto set = [&](Landmark landmark, const glm::dvec3& place) { marks[Index(landmark)] = place; };
  const glm::dvec3 neck = hips + glm::dvec3(0, 0.5, 0);
  set(kNeck, neck);
  set(kHead, neck + glm::dvec3(0, 0.25, 0));
  set(kNose, neck + glm::dvec3(0, 0.15, 0.1));
  for (const double side : {1.0, -1.0}) {
    const bool is_left = side > 0;
    const double phase = 4 * seconds + (is_left ? 0 : 3.1);
    const double hip = 0.4 * std::sin(phase), knee = hip - 0.3 - 0.25 * std::sin(phase + 1);
    const glm::dvec3 at_hip = hips + glm::dvec3(0.09 * side, 0, 0);
    const glm::dvec3 at_knee = at_hip + 0.43 * down(hip), at_ankle = at_knee + 0.42 * down(knee);
    set(is_left ? kLeftHip : kRightHip, at_hip);
    set(is_left ? kLeftKnee : kRightKnee, at_knee);
    set(is_left ? kLeftAnkle : kRightAnkle, at_ankle);
    const glm::dvec3 toe = at_ankle + 0.18 * down(knee + 1.35);
    set(is_left ? kLeftBigToe : kRightBigToe, toe);
    const double arm = -0.5 * std::sin(phase), elbow = arm + 0.5 + 0.3 * std::sin(phase);
    const glm::dvec3 at_shoulder = neck + glm::dvec3(0.18 * side, 0, 0);
    const glm::dvec3 at_elbow = at_shoulder + 0.29 * down(arm), at_wrist = at_elbow + 0.25 * down(elbow);
    set(is_left ? kLeftShoulder : kRightShoulder, at_shoulder);
    set(is_left ? kLeftElbow : kRightElbow, at_elbow);
    set(is_left ? kLeftWrist : kRightWrist, at_wrist);
  }
  return marks;
}

/// Returns the keypoints of the figure in a camera, with noise of `sigma_px` on each coordinate.
inline SeenPerson Seen(const Camera& camera, const LandmarkPositions& places, double sigma_px, RandomStream& dice) {
  SeenPerson person;
  for (std::size_t i = 0; i < kLandmarkCount; ++i) {
    const auto pixel = places[i] ? Project(camera, *places[i]) : std::nullopt;
    const double v = dice.Normal(), u = dice.Normal();
    if (pixel) person.keypoints[i] = {*pixel + sigma_px * glm::dvec2(u, v), 0.8};
  }
  return person;
}

inline RandomStream WalkersDice(const char* purpose) {
  return RandomStream(WorldKey{.suite_seed = 1, .scenario = "walkers", .trial = 0}, purpose);
}

}  // namespace etude
