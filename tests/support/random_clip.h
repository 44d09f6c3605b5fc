#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/motion/clip.h"

namespace etude::testing {

/// Pseudo-random numbers, the same on every machine.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed) {}

  std::uint32_t Below(std::size_t limit) {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::uint32_t>((state_ >> 33) % limit);
  }
  /// Draws a number in [−1, 1), in steps of 2⁻³⁰.
  double Signed() { return Below(std::size_t{1} << 31) / 1073741824.0 - 1; }
  glm::dvec3 Vector() {
    const double x = Signed(), y = Signed();
    return {x, y, Signed()};
  }
  glm::dquat Rotation() {
    const double w = Signed();
    const glm::dvec3 v = Vector();
    return glm::normalize(glm::dquat(w, v.x, v.y, v.z));
  }

 private:
  std::uint64_t state_;
};

struct RandomClipOptions {
  int roots = 1;
  bool rest_rotations = false;
  bool moving_offsets = false;
  bool scales = false;  ///< scales joints by 0.5 to 2 per axis, at rest and in every frame
};

/// Returns a clip of ten joints in a random tree, with lengths around 1, rotated at random in each of five frames.
inline Clip RandomClip(std::uint64_t seed, const RandomClipOptions& options = {}) {
  constexpr int kJoints = 10, kFrames = 5;
  Dice dice(seed);
  const auto scale = [&] {
    return options.scales ? glm::dvec3(std::exp2(dice.Signed()), std::exp2(dice.Signed()), std::exp2(dice.Signed()))
                          : glm::dvec3(1);
  };
  Clip clip{.name = "random", .skeleton = {}, .rate_hz = 30, .frames = {}};
  for (int i = 0; i < kJoints; ++i) {
    const int parent = i < options.roots ? -1 : static_cast<int>(dice.Below(i));
    LocalTransform rest{.translation = dice.Vector()};
    if (options.rest_rotations) rest.rotation = dice.Rotation();
    rest.scale = scale();
    clip.skeleton.joints.push_back({.name = "joint" + std::to_string(i), .parent = parent, .rest = rest});
  }
  for (int f = 0; f < kFrames; ++f) {
    LocalPose pose = RestPose(clip.skeleton);
    for (int i = 0; i < kJoints; ++i) {
      if (options.moving_offsets || clip.skeleton.joints[i].parent < 0) pose[i].translation = dice.Vector();
      pose[i].rotation = dice.Rotation();
      pose[i].scale = scale();
    }
    clip.frames.push_back(std::move(pose));
  }
  return clip;
}

/// Returns the largest distance, over all frames, between joints of the same name in `a` and `b`; 10⁹ or more if a name
/// is missing or the numbers of frames differ.
inline double WorstDistance(const Clip& a, const Clip& b) {
  double worst = a.frames.size() == b.frames.size() ? 0 : 1e9;
  std::vector<GlobalTransform> of_a, of_b;
  for (std::size_t f = 0; f < std::min(a.frames.size(), b.frames.size()); ++f) {
    ComputeGlobals(a.skeleton, a.frames[f], of_a);
    ComputeGlobals(b.skeleton, b.frames[f], of_b);
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      const int twin = b.skeleton.Find(a.skeleton.joints[i].name);
      worst = std::max(worst, twin < 0 ? 1e9 : glm::distance(of_a[i].position, of_b[twin].position));
    }
  }
  return worst;
}

inline bool IsFinite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

inline Clip Resting(const Clip& clip) {
  return {.name = clip.name, .skeleton = clip.skeleton, .rate_hz = clip.rate_hz, .frames = {RestPose(clip.skeleton)}};
}

}  // namespace etude::testing
