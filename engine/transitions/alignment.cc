#include "engine/transitions/alignment.h"

#include <algorithm>

namespace etude {

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
