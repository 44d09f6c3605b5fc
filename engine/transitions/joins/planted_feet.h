#pragma once

#include <span>
#include <vector>

#include "engine/transitions/joins/foot_contacts.h"
#include "engine/transitions/joins/minimum_jerk.h"

namespace etude {

/// The move on the floor that lays the new motion so that feet which stand in both motions, at the same frames after
/// the point, stand in the same places: least squares over toe tips and ankles, and, weaker, over hips and shoulders at
/// the point, which decide alone where no foot stands. `old` and `next`: frames from the point on, one at least each.
FloorMove AlignOnPlantedFeet(std::span<const BodyPose> old, std::span<const BodyPose> next, double rate_hz);

/// When a foot changes over from the old motion's path to the new one's, and how high it is lifted on the way.
struct FootStep {
  bool keeps = false;  ///< the foot is left where the limbs put it: it stands in neither motion
  double begin = 0;    ///< frames after the point
  double end = 1;
  double lift = 0;  ///< metres at the middle of the step
};
/// By side.
using FootPlan = std::array<FootStep, 2>;

/// Plans a step for each foot within the window: the two one after the other where both must travel, long ones so that
/// they accelerate little, while the foot is in the air anyway where it is. Ours.
FootPlan PlanSteps(const JoinWindow& window);

/// Puts the feet of `played` (PlayMinimumJerk's) onto their paths, and lowers the pelvis where a leg is too short.
/// Limbs keep their lengths; the first frame stays as it is.
void PlantFeet(const JoinWindow& window, std::vector<BodyPose>& played);

/// MinimumJerk with PlantFeet, the new motion laid by AlignOnPlantedFeet.
Blend PlantedFeet(const JoinInput& input, const MinimumJerkOptions& options);

}  // namespace etude
