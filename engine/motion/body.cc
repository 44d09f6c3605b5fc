#include "engine/motion/body.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

struct RoleFacts {
  std::string_view name;
  Role parent;  // the root is its own parent
  Role mirrored;
};

using enum Role;

constexpr std::array<RoleFacts, kRoleCount> kFacts = {{
    {"hip_centre", kHipCentre, kHipCentre},
    {"spine", kHipCentre, kSpine},
    {"shoulder_centre", kSpine, kShoulderCentre},
    {"head", kShoulderCentre, kHead},
    {"left_shoulder", kShoulderCentre, kRightShoulder},
    {"left_elbow", kLeftShoulder, kRightElbow},
    {"left_wrist", kLeftElbow, kRightWrist},
    {"left_hand", kLeftWrist, kRightHand},
    {"right_shoulder", kShoulderCentre, kLeftShoulder},
    {"right_elbow", kRightShoulder, kLeftElbow},
    {"right_wrist", kRightElbow, kLeftWrist},
    {"right_hand", kRightWrist, kLeftHand},
    {"left_hip", kHipCentre, kRightHip},
    {"left_knee", kLeftHip, kRightKnee},
    {"left_ankle", kLeftKnee, kRightAnkle},
    {"left_foot", kLeftAnkle, kRightFoot},
    {"right_hip", kHipCentre, kLeftHip},
    {"right_knee", kRightHip, kLeftKnee},
    {"right_ankle", kRightKnee, kLeftAnkle},
    {"right_foot", kRightAnkle, kLeftFoot},
}};

constexpr std::array<Role, kRoleCount> kRoles = [] {
  std::array<Role, kRoleCount> roles{};
  for (std::size_t i = 0; i < kRoleCount; ++i) roles[i] = static_cast<Role>(i);
  return roles;
}();

constexpr std::array<Bone, kRoleCount - 1> kBones = [] {
  std::array<Bone, kRoleCount - 1> bones{};
  for (std::size_t i = 1; i < kRoleCount; ++i) bones[i - 1] = {kFacts[i].parent, static_cast<Role>(i)};
  return bones;
}();

constexpr std::array<Bone, 8> kArmAndLegBones = {{{kLeftShoulder, kLeftElbow},
                                                  {kLeftElbow, kLeftWrist},
                                                  {kRightShoulder, kRightElbow},
                                                  {kRightElbow, kRightWrist},
                                                  {kLeftHip, kLeftKnee},
                                                  {kLeftKnee, kLeftAnkle},
                                                  {kRightHip, kRightKnee},
                                                  {kRightKnee, kRightAnkle}}};

}  // namespace

std::span<const Role, kRoleCount> AllRoles() { return kRoles; }

std::string_view RoleName(Role role) { return kFacts[Index(role)].name; }

std::optional<Role> FindRole(std::string_view name) {
  for (Role role : kRoles) {
    if (RoleName(role) == name) return role;
  }
  return std::nullopt;
}

std::optional<Role> ParentOf(Role role) {
  if (role == kHipCentre) return std::nullopt;
  return kFacts[Index(role)].parent;
}

Role Mirrored(Role role) { return kFacts[Index(role)].mirrored; }

std::span<const Bone, kRoleCount - 1> AllBones() { return kBones; }
std::span<const Bone, 8> ArmAndLegBones() { return kArmAndLegBones; }

double BoneLength(const BodyPose& pose, const Bone& bone) { return glm::distance(pose[bone.parent], pose[bone.child]); }

glm::dvec3 FloorMove::Apply(const glm::dvec3& point) const {
  const double c = std::cos(yaw), s = std::sin(yaw);
  return {c * point.x + s * point.z + x, point.y, -s * point.x + c * point.z + z};
}

BodyPose FloorMove::Apply(const BodyPose& pose) const {
  const double c = std::cos(yaw), s = std::sin(yaw);
  BodyPose moved;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    const glm::dvec3& point = pose.joints[i];
    moved.joints[i] = {c * point.x + s * point.z + x, point.y, -s * point.x + c * point.z + z};
  }
  return moved;
}

glm::dvec3 Facing(const BodyPose& pose) {
  // The vectors from right to left hip and from right to left shoulder point to the person's left (+X at rest); left ×
  // up is forward.
  const glm::dvec3 left = (pose[kLeftHip] - pose[kRightHip]) + (pose[kLeftShoulder] - pose[kRightShoulder]);
  const glm::dvec3 forward = glm::cross(left, glm::dvec3(0, 1, 0));
  const double length = glm::length(forward);
  constexpr double kDegenerate = 1e-9;
  return length < kDegenerate ? glm::dvec3(0, 0, 1) : forward / length;
}

double Heading(const BodyPose& pose) {
  const glm::dvec3 forward = Facing(pose);
  return std::atan2(forward.x, forward.z);
}

FloorMove ToOrigin(const BodyPose& pose) {
  FloorMove turn{.yaw = -Heading(pose)};
  const glm::dvec3 hips = turn.Apply(pose[kHipCentre]);
  return {.yaw = turn.yaw, .x = -hips.x, .z = -hips.z};
}

FloorMove AlignOnFloor(const BodyPose& pose, const BodyPose& onto) {
  const FloorMove turn{.yaw = Heading(onto) - Heading(pose)};
  const glm::dvec3 shift = onto[Role::kHipCentre] - turn.Apply(pose[Role::kHipCentre]);
  return {.yaw = turn.yaw, .x = shift.x, .z = shift.z};
}

double PoseGap(const BodyPose& a, const BodyPose& b) {
  const BodyPose moved = AlignOnFloor(b, a).Apply(b);
  double worst = 0;
  for (Role role : AllRoles()) worst = std::max(worst, glm::distance(a[role], moved[role]));
  return worst;
}

}  // namespace etude
