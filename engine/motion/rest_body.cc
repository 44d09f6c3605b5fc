#include "engine/motion/rest_body.h"

#include <cassert>

namespace etude {
namespace {

using enum Role;

// Returns a limb's name: the name of the joint about which it rotates, unless several limbs share that joint.
std::string NameOfLimbTo(const Bone& bone) {
  if (bone.child == kSpine) return "lower_back";
  if (bone.child == kLeftShoulder) return "left_collar";
  if (bone.child == kRightShoulder) return "right_collar";
  return std::string(RoleName(bone.parent));
}

}  // namespace

glm::dvec3 DirectionAtRest(Role child) {
  switch (child) {
    case kSpine:
    case kShoulderCentre:
    case kHead:
      return {0, 1, 0};
    case kLeftShoulder:
    case kLeftHip:
      return {1, 0, 0};
    case kRightShoulder:
    case kRightHip:
      return {-1, 0, 0};
    case kLeftFoot:
    case kRightFoot:
      return {0, 0, 1};
    default:
      return {0, -1, 0};
  }
}

BodyPose RestBody::Pose() const {
  BodyPose pose;
  for (const Role role : AllRoles()) pose[role] = roles[Index(role)].position;
  return pose;
}

RestBody RestBodyOf(std::span<const BodyPose> poses) {
  assert(!poses.empty());
  RestBody body;
  body.joints.push_back({.name = std::string(RoleName(kHipCentre))});
  body.roles[Index(kHipCentre)] = {0, glm::dvec3(0)};
  for (const Bone& bone : AllBones()) {
    double sum = 0;
    for (const BodyPose& pose : poses) sum += BoneLength(pose, bone);
    const RestBody::RoleAnchor upper = body.roles[Index(bone.parent)];
    const glm::dvec3 lower = upper.position + sum / static_cast<double>(poses.size()) * DirectionAtRest(bone.child);
    int joint = 0;  // index of the pelvis, to which both hips are fixed
    if (bone.child != kLeftHip && bone.child != kRightHip) {
      joint = static_cast<int>(body.joints.size());
      body.joints.push_back({NameOfLimbTo(bone), upper.joint, upper.position});
    }
    body.roles[Index(bone.child)] = {joint, lower};
  }
  return body;
}

}  // namespace etude
