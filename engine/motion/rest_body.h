#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// Returns the direction at rest of the limb that ends in a joint: a person who stands with hanging arms, facing +Z;
/// hips and shoulders to the person's left are +X.
glm::dvec3 DirectionAtRest(Role child);

/// One person's body as it can be measured before a take: its joints in some pose at rest, metres, Y up, facing +Z. It
/// says how far joints are from each other, and nothing of how they turn.
struct RestBody {
  struct Joint {
    std::string name;
    int parent = -1;
    glm::dvec3 position{0};
  };
  /// A point that is fixed to a joint.
  struct RolePlace {
    int joint = 0;
    glm::dvec3 position{0};
  };
  std::vector<Joint> joints;  ///< parents before children; the first one is the only root
  std::array<RolePlace, kRoleCount> roles;

  /// The twenty joints at rest.
  BodyPose Pose() const;
};

/// Makes a body of the twenty roles alone: a rigid pelvis with both hips, and every other limb a joint of its own, each
/// as long as it is on average over `poses`, of which there is one at least. It stands with hanging arms.
RestBody RestBodyOf(std::span<const BodyPose> poses);

}  // namespace etude
