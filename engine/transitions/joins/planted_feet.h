#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/support.h"
#include "engine/transitions/joins/minimum_jerk.h"

namespace etude {

/// The joints of a leg, from the hip down.
struct LegRoles {
  Role hip, knee, ankle, foot;
};
/// The legs by side.
constexpr std::array<LegRoles, 2> kLegs = {
    LegRoles{Role::kLeftHip, Role::kLeftKnee, Role::kLeftAnkle, Role::kLeftFoot},
    LegRoles{Role::kRightHip, Role::kRightKnee, Role::kRightAnkle, Role::kRightFoot}};

/// The move on the floor that lays the new motion so that feet which stand in both motions, at the same frames after
/// the point, stand in the same places: least squares over toe tips and ankles, and, weaker, over hips and shoulders at
/// the point, which decide alone where no foot stands. `old` and `next`: frames from the point on, one at least each.
FloorMove AlignOnPlantedFeet(std::span<const BodyPose> old, std::span<const BodyPose> next, double rate_hz);

/// A foot's change from the old motion's path to the new one's: when it happens, and how high the foot is lifted.
struct FootStep {
  bool keeps = false;  ///< the foot is left where the limbs put it: it stands in neither motion
  double begin = 0;    ///< frames after the point
  double end = 1;
  double lift = 0;  ///< metres at the middle of the step
};
/// The changes of both feet, by side.
using FootPlan = std::array<FootStep, 2>;

/// Plans a step for each foot within the window: the two one after the other where both must travel, long ones so that
/// they accelerate little, while the foot is in the air anyway where it is. Ours.
FootPlan PlanSteps(const JoinWindow& window);

/// Puts the feet of `played` (PlayMinimumJerk's) onto their paths, and lowers the pelvis where a leg is too short.
/// Limbs keep their lengths; the first frame stays as it is.
void PlantFeet(const JoinWindow& window, std::vector<BodyPose>& played);

/// Joins by MinimumJerk with PlantFeet, the new motion laid by AlignOnPlantedFeet.
Blend PlantedFeet(const JoinInput& input, const MinimumJerkOptions& options);

}  // namespace etude
