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
/// the point, which decide alone where no foot stands, and from which feet turn the body by 30° at most: in the
/// shortest join that is 190° a second. `old` and `next`: frames from the point on, one at least each.
FloorMove AlignOnPlantedFeet(std::span<const BodyPose> old, std::span<const BodyPose> next, double rate_hz);

/// A foot's change from the old motion's path to the new one's. Until it begins the foot follows the old motion, or
/// stays where that last stood; from its end on it follows the new one, or waits where that will stand.
struct FootStep {
  bool keeps = false;  ///< the foot is left where the limbs put it: it stands in neither motion
  int begin = 0;       ///< frames after the point
  int end = 1;
  double lift = 0;            ///< metres at the middle of the step
  int stays_from = kNoFrame;  ///< the foot stays where the old motion has it at this frame
  int waits_until = -1;       ///< the foot waits where the new motion has it at this frame

  static constexpr int kNoFrame = 1 << 30;
};
/// The changes of both feet, by side, and what they cost the body.
struct FootPlan {
  std::array<FootStep, 2> steps;
  int unborne = 0;  ///< frames in which a foot stands in one of the motions, and none stands by this plan
};

/// Plans a step for each foot within the window: long ones, so that they accelerate little, and one after the other, so
/// that one foot stands while the other travels. Ours.
FootPlan PlanSteps(const JoinWindow& window);

/// Puts the feet of `played` (PlayMinimumJerk's) onto their paths, and lowers the pelvis where a leg is too short.
/// Limbs keep their lengths; the first frame stays as it is. Returns FootPlan::unborne.
int PlantFeet(const JoinWindow& window, std::vector<BodyPose>& played);

/// Joins by MinimumJerk with PlantFeet, the new motion laid by AlignOnPlantedFeet.
Blend PlantedFeet(const JoinInput& input, const MinimumJerkOptions& options);

}  // namespace etude
