#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/kinematics/body_tree.h"
#include "engine/motion/rest_body.h"

namespace etude {

/// Returns the twenty roles of paper B's default body, each limb separate.
inline RestBody PlainRestBody() {
  const std::vector<BodyPose> standing = {ToBodyPose(MakeBodyTree({}), StandingState(MakeBodyTree({})))};
  return RestBodyOf(standing);
}

/// Returns the same body with the joints of mocap files: a hip joint that rotates nothing, a second spine joint with
/// collars and neck, a neck of two joints, and toes that bend.
inline RestBody JointedRestBody() {
  RestBody body = PlainRestBody();
  const auto add = [&](const char* name, int parent, const glm::dvec3& at) {
    body.joints.push_back({name, parent, at});
    return static_cast<int>(body.joints.size()) - 1;
  };
  const auto place = [&](Role role) { return body.roles[Index(role)].position; };
  // The foot bends at its ball, a little below the straight line to the toes.
  for (const Role foot : {Role::kLeftFoot, Role::kRightFoot}) {
    RestBody::RoleAnchor& tip = body.roles[Index(foot)];
    tip.joint = add("toe", tip.joint, glm::mix(place(*ParentOf(foot)), tip.position, 0.7) + glm::dvec3(0, -0.02, 0));
  }
  RestBody::RoleAnchor& head = body.roles[Index(Role::kHead)];
  head.joint = add("upper_neck", head.joint,
                   glm::mix(place(Role::kShoulderCentre), head.position, 0.4) + glm::dvec3(0, 0, 0.02));
  RestBody::RoleAnchor& neck = body.roles[Index(Role::kShoulderCentre)];
  neck.joint = add("chest", neck.joint, glm::mix(place(Role::kSpine), neck.position, 0.6) + glm::dvec3(0, 0, -0.01));
  add("nub", head.joint, head.position + glm::dvec3(0, 0.1, 0));
  return body;
}

/// Returns the same body with a depth sensor's joints: a rigid trunk; separate joints in its middle carry hips and
/// shoulders.
inline RestBody SensorRestBody() {
  using enum Role;
  const BodyPose rest = PlainRestBody().Pose();
  RestBody body{.joints = {{"torso", -1, rest[kSpine]}}, .roles = {}};
  const auto hang = [&](Role role, int joint) { body.roles[Index(role)] = {joint, rest[role]}; };
  const auto add = [&](const std::string& name, int parent, const glm::dvec3& at) {
    body.joints.push_back({name, parent, at});
    return static_cast<int>(body.joints.size()) - 1;
  };
  for (const Role role : {kHipCentre, kSpine, kShoulderCentre}) hang(role, 0);
  for (const auto& limb : {std::array{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot},
                           {kRightHip, kRightKnee, kRightAnkle, kRightFoot},
                           {kLeftShoulder, kLeftElbow, kLeftWrist, kLeftHand},
                           {kRightShoulder, kRightElbow, kRightWrist, kRightHand}}) {
    int joint = add("to_" + std::string(RoleName(limb[0])), 0, rest[kSpine]);
    for (std::size_t i = 0; i < 3; ++i) {
      joint = add(std::string(RoleName(limb[i])), joint, rest[limb[i]]);
      hang(limb[i], joint);
    }
    hang(limb[3], joint);
  }
  hang(kHead, add("neck", 0, rest[kShoulderCentre]));
  return body;
}

}  // namespace etude
