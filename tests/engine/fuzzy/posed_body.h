#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "engine/base/angles.h"
#include "engine/motion/body.h"

namespace etude {

// Directions of the world, named for a body that faces +Z.
inline const glm::dvec3 kForward(0, 0, 1), kLeftwards(1, 0, 0), kUp(0, 1, 0), kDown(0, -1, 0);

/// A standing body with limbs at chosen angles, so that a test can write down a pose. Lengths are in metres; the hip
/// joints are 0.9 above the floor.
struct PosedBody {
  struct Limb {
    glm::dvec3 upper{0, -1, 0};  ///< direction of upper arm or thigh
    glm::dvec3 lower{0, -1, 0};  ///< direction of forearm or shank
  };
  Limb left_arm, right_arm, left_leg, right_leg;
  double twist = 0;  ///< radians, of the shoulders about the trunk

  /// Returns the direction of a limb raised by `degrees` from hanging, towards `towards` (horizontal unit vector).
  static glm::dvec3 Raised(double degrees, const glm::dvec3& towards) {
    return std::cos(Radians(degrees)) * glm::dvec3(0, -1, 0) + std::sin(Radians(degrees)) * towards;
  }

  BodyPose Pose() const {
    using enum Role;
    constexpr double kUpperArm = 0.25, kForearm = 0.23, kThigh = 0.42, kShank = 0.42, kHalfHips = 0.09;
    constexpr double kHalfShoulders = 0.18, kTrunk = 0.5;
    BodyPose pose;
    const glm::dvec3 hips(0, 0.9, 0);
    const glm::dvec3 shoulders = hips + glm::dvec3(0, kTrunk, 0);
    const glm::dvec3 side(std::cos(twist), 0, -std::sin(twist));
    pose[kHipCentre] = hips;
    pose[kSpine] = 0.5 * (hips + shoulders);
    pose[kShoulderCentre] = shoulders;
    pose[kHead] = shoulders + glm::dvec3(0, 0.25, 0);
    const auto hang = [&](const glm::dvec3& start, const Limb& limb, double upper, double lower, Role first) {
      pose[first] = start;
      pose[static_cast<Role>(Index(first) + 1)] = start + upper * limb.upper;
      pose[static_cast<Role>(Index(first) + 2)] = start + upper * limb.upper + lower * limb.lower;
      pose[static_cast<Role>(Index(first) + 3)] = pose[static_cast<Role>(Index(first) + 2)];
    };
    hang(shoulders + kHalfShoulders * side, left_arm, kUpperArm, kForearm, kLeftShoulder);
    hang(shoulders - kHalfShoulders * side, right_arm, kUpperArm, kForearm, kRightShoulder);
    hang(hips + glm::dvec3(kHalfHips, 0, 0), left_leg, kThigh, kShank, kLeftHip);
    hang(hips - glm::dvec3(kHalfHips, 0, 0), right_leg, kThigh, kShank, kRightHip);
    return pose;
  }

  static constexpr double kStandingHipHeight = 0.9;
};

}  // namespace etude
