#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>

#include "engine/motion/body.h"
#include "sim/choreography/canonical_body.h"

namespace etude {

/// Rotates `from`, and every joint below it in the tree, about `from`.
inline BodyPose Turned(BodyPose pose, Role from, const glm::dquat& turn) {
  const glm::dvec3 pivot = pose[from];
  std::array<bool, kRoleCount> below{};
  below[Index(from)] = true;
  for (const Role role : AllRoles()) {
    const auto parent = ParentOf(role);
    if (!parent || !below[Index(*parent)]) continue;
    below[Index(role)] = true;
    pose[role] = pivot + turn * (pose[role] - pivot);
  }
  return pose;
}

inline BodyPose MirrorImage(const BodyPose& pose) {
  BodyPose mirrored;
  for (const Role role : AllRoles()) mirrored[Mirrored(role)] = pose[role] * glm::dvec3(-1, 1, 1);
  return mirrored;
}

/// Returns a body that stands with straight legs and toes ahead, so that all hinges lie along X.
inline BodyPose AtAttention() {
  BodyPose pose = StandingPose();
  for (const Role hip : {Role::kLeftHip, Role::kRightHip}) {
    glm::dvec3* leg = &pose[hip];
    leg[1] = leg[0] - glm::dvec3(0, 0.42, 0);
    leg[2] = leg[1] - glm::dvec3(0, 0.41, 0);
    leg[3] = leg[2] + glm::dvec3(0, -0.04, 0.17);
  }
  return pose;
}

}  // namespace etude
