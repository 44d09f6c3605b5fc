#include "engine/silhouettes/turned_round.h"

#include "engine/base/angles.h"
#include "engine/silhouettes/fit_joints.h"
#include "engine/silhouettes/turns.h"

namespace etude {

TreeState TurnedRound(const SilhouetteBody& body, const TreeState& state) {
  constexpr double kExact = 0.05;  // metres
  const BodyPose pose = ToBodyPose(body, state);
  BodyPose exchanged;
  for (const Role role : AllRoles()) exchanged[role] = pose[Mirrored(role)];
  JointTargets targets = TargetsOf(exchanged, kExact);
  for (const Role role : {Role::kLeftFoot, Role::kRightFoot, Role::kHead}) targets[Index(role)].reset();
  TreeState start = state;
  start.root_frame = RotationBy({0, kPi, 0}) * state.root_frame;
  return FitJoints(body, targets, start);
}

}  // namespace etude
