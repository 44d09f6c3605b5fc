#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// The body that performs all clips of a library: how long its limbs are, and how high its hips stand.
struct BodyProportions {
  /// The limbs' lengths, metres, by the limb's child joint; the hip centre's entry is 0.
  std::array<double, kRoleCount> limb_lengths{};
  double standing_hip_height = 0;  ///< metres, as `StandingHipHeight` reads it
};

/// Returns the proportions of `pose`, scaled so that the hips stand `standing_hip_height` metres high. `pose` must have
/// legs.
BodyProportions MakeBodyProportions(const BodyPose& pose, double standing_hip_height);

/// Returns the body at rest over the origin, facing +Z: limbs straight, arms hanging, soles on the floor.
BodyPose StandingPose(const BodyProportions& proportions);

/// Returns the same motions, performed by a body of these proportions. Paper A's clips all belong to one character;
/// real clips come from many people, and a transition between two bodies would be seen whatever the pose.
///
/// Every limb keeps its direction and gets its new length; travel and hip height scale with the legs; then the clips
/// are set down, so that the lower foot is on or below the floor in 5 % of the frames. Clips whose legs are equally
/// long (to a tenth of a millimetre, in their first frame) are one person's and set down together: who only sits in one
/// clip sits as high there as after sitting down in another. None of them goes below the floor for that: limbs of other
/// lengths may take it there, and it is set down by itself then. A limb of zero length in the source follows its parent
/// limb's direction.
std::vector<BodyMotion> PerformedBy(const BodyProportions& proportions, std::span<const BodyMotion> motions);

}  // namespace etude
