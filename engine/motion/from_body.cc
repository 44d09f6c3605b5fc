#include "engine/motion/from_body.h"

#include <cassert>
#include <optional>
#include <utility>

namespace etude {
namespace {

glm::dvec3 FromParent(const BodyPose& pose, Role role) {
  const std::optional<Role> parent = ParentOf(role);
  return parent ? pose[role] - pose[*parent] : pose[role];
}

}  // namespace

Skeleton BodySkeleton(const BodyPose& rest) {
  Skeleton skeleton;
  for (const Role role : AllRoles()) {
    const std::optional<Role> parent = ParentOf(role);
    skeleton.joints.push_back({.name = std::string(RoleName(role)),
                               .parent = parent ? static_cast<int>(Index(*parent)) : -1,
                               .rest = {.translation = FromParent(rest, role)}});
  }
  return skeleton;
}

Clip ToClip(const BodyMotion& motion, std::string name) {
  assert(!motion.poses.empty());
  Clip clip{
      .name = std::move(name), .skeleton = BodySkeleton(motion.poses.front()), .rate_hz = motion.rate_hz, .frames = {}};
  for (const BodyPose& pose : motion.poses) {
    LocalPose& frame = clip.frames.emplace_back();
    for (const Role role : AllRoles()) frame.push_back({.translation = FromParent(pose, role)});
  }
  return clip;
}

}  // namespace etude
