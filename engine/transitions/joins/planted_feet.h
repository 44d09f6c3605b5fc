#pragma once

#include <array>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/support.h"
#include "engine/transitions/joins/minimum_jerk.h"

namespace etude {

/// The joints of a leg, from the hip to the foot.
struct LegRoles {
  Role hip, knee, ankle, foot;
};
/// The legs, indexed by side.
constexpr std::array<LegRoles, 2> kLegs = {
    LegRoles{Role::kLeftHip, Role::kLeftKnee, Role::kLeftAnkle, Role::kLeftFoot},
    LegRoles{Role::kRightHip, Role::kRightKnee, Role::kRightAnkle, Role::kRightFoot}};

/// The step that takes a foot from the old motion's path to the new motion's path. Before the step the foot follows the
/// old motion, or keeps the position of its last stance in that motion. After the step it follows the new motion, or
/// already takes the position of its next stance in that motion.
struct FootStep {
  bool keeps = false;  ///< true if the foot stands in neither motion; its path is not changed
  int begin = 0;       ///< frame of the join at which the step begins
  int end = 1;
  double lift = 0;            ///< height in the middle of the step, metres
  int stays_from = kNoFrame;  ///< until the step, the foot keeps its position in this frame of the old motion
  int waits_until = -1;       ///< from the step until this frame, the foot has this frame's position in the new motion

  static constexpr int kNoFrame = 1 << 30;
};
/// The steps of both feet, indexed by side.
struct FootPlan {
  std::array<FootStep, 2> steps;
  int unplanted_frames = 0;  ///< frames in which a foot stands in one of the motions, but no foot stands by this plan
};

/// Plans a step for each foot within the window (ours). It prefers long steps, because they need little acceleration,
/// and steps one after the other, because one foot then supports the body while the other moves. Steps cost more if the
/// hips turn by more than 30° against a standing foot, or if a foot is out of the leg's reach. A window of fewer than
/// two frames has no steps.
FootPlan PlanSteps(const JoinWindow& window);

/// Moves the feet of `played` (from PlayMinimumJerk) to the paths of a plan (PlanSteps), and lowers the pelvis if a leg
/// is too short. Limbs keep their lengths, and the first frame does not change.
void PlantFeet(const JoinWindow& window, const FootPlan& plan, std::vector<BodyPose>& played);

/// Joins by MinimumJerk with PlantFeet. SpliceSegments aligns the new motion by AlignOnPlantedFeet, and shifts it by
/// CarriedShift if the choice of frames prefers that (PreferredJoin::carried).
Blend PlantedFeet(const JoinInput& input, const MinimumJerkOptions& options);

}  // namespace etude
