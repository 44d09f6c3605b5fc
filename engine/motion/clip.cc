#include "engine/motion/clip.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

namespace etude {

int Skeleton::Find(const std::string& name) const {
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (joints[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

LocalPose RestPose(const Skeleton& skeleton) {
  LocalPose rest;
  rest.reserve(skeleton.joints.size());
  for (const Joint& joint : skeleton.joints) rest.push_back(joint.rest);
  return rest;
}

void ComputeGlobals(const Skeleton& skeleton, const LocalPose& pose, std::vector<GlobalTransform>& out) {
  out.resize(skeleton.joints.size());
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    const LocalTransform& local = pose[i];
    glm::dmat3 axes = glm::mat3_cast(local.rotation);
    for (int k = 0; k < 3; ++k) axes[k] *= local.scale[k];
    const int parent = skeleton.joints[i].parent;
    if (parent < 0) {
      out[i] = {local.translation, axes};
    } else {
      const GlobalTransform& above = out[parent];
      out[i] = {above.position + above.axes * local.translation, above.axes * axes};
    }
  }
}

LocalTransform Between(const LocalTransform& from, const LocalTransform& to, double part) {
  return {.translation = glm::mix(from.translation, to.translation, part),
          .rotation = glm::slerp(from.rotation, to.rotation, part),
          .scale = glm::mix(from.scale, to.scale, part)};
}

LocalPose SampleFrame(const Clip& clip, double frame) {
  assert(!clip.frames.empty());
  const double last = static_cast<double>(clip.frames.size() - 1);
  const double at = std::clamp(frame, 0.0, last);
  const auto index = static_cast<std::size_t>(at);
  const double part = at - static_cast<double>(index);
  LocalPose pose = clip.frames[index];
  if (part == 0) return pose;
  const LocalPose& next = clip.frames[index + 1];
  for (std::size_t i = 0; i < pose.size(); ++i) pose[i] = Between(pose[i], next[i], part);
  return pose;
}

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
