#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// Returns the unit direction, at rest, of the limb that ends in joint `child`. At rest a person stands with hanging
/// arms and faces +Z; the left hip and shoulder point to +X.
glm::dvec3 DirectionAtRest(Role child);

/// One person's body as measured before a take: its joints in a rest pose, metres, Y up, facing +Z. A RestBody has no
/// axes of rotation.
struct RestBody {
  struct Joint {
    std::string name;
    int parent = -1;
    glm::dvec3 position{0};
  };
  /// A point that is fixed to a joint.
  struct RoleAnchor {
    int joint = 0;
    glm::dvec3 position{0};
  };
  std::vector<Joint> joints;  ///< parents before children; the first one is the only root
  std::array<RoleAnchor, kRoleCount> roles;

  /// Returns the twenty joints at rest.
  BodyPose Pose() const;
};

/// Makes a body of the twenty roles only: a rigid pelvis with both hips, and one joint for every other limb. Each limb
/// has its mean length over `poses`, of which there must be at least one. The body stands with hanging arms.
RestBody RestBodyOf(std::span<const BodyPose> poses);

}  // namespace etude
