#pragma once

#include <vector>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/tree_to_body.h"
#include "engine/motion/rest_body.h"

namespace etude {

/// The twenty roles of paper B's default body, each limb by itself.
inline RestBody PlainRestBody() {
  const std::vector<BodyPose> standing = {ToBodyPose(MakeBodyTree({}), StandingState(MakeBodyTree({})))};
  return RestBodyOf(standing);
}

/// The same as mocap files have bodies: a hip joint that turns nothing, a second spine joint from which collars and
/// neck leave, a neck of two joints, toes that bend.
inline RestBody JointedRestBody() {
  RestBody body = PlainRestBody();
  const auto add = [&](const char* name, int parent, const glm::dvec3& at) {
    body.joints.push_back({name, parent, at});
    return static_cast<int>(body.joints.size()) - 1;
  };
  const auto place = [&](Role role) { return body.roles[Index(role)].position; };
  // Toes: the foot bends where its ball is, a little below the straight line.
  for (const Role foot : {Role::kLeftFoot, Role::kRightFoot}) {
    RestBody::RolePlace& tip = body.roles[Index(foot)];
    tip.joint = add("toe", tip.joint, glm::mix(place(*ParentOf(foot)), tip.position, 0.7) + glm::dvec3(0, -0.02, 0));
  }
  RestBody::RolePlace& head = body.roles[Index(Role::kHead)];
  head.joint = add("upper_neck", head.joint,
                   glm::mix(place(Role::kShoulderCentre), head.position, 0.4) + glm::dvec3(0, 0, 0.02));
  RestBody::RolePlace& neck = body.roles[Index(Role::kShoulderCentre)];
  neck.joint = add("chest", neck.joint, glm::mix(place(Role::kSpine), neck.position, 0.6) + glm::dvec3(0, 0, -0.01));
  add("nub", head.joint, head.position + glm::dvec3(0, 0.1, 0));
  return body;
}

}  // namespace etude
