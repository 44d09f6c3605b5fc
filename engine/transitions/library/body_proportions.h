#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// The body that performs all clips of a library: its limb lengths and its standing hip height.
struct BodyProportions {
  /// The limb lengths in metres, indexed by the limb's child joint; the entry of the hip centre is 0.
  std::array<double, kRoleCount> limb_lengths{};
  double standing_hip_height = 0;  ///< metres, as computed by `StandingHipHeight`
};

/// Returns the proportions of `pose`, scaled to a standing hip height of `standing_hip_height` metres. The legs of
/// `pose` must have a length above 0.
BodyProportions MakeBodyProportions(const BodyPose& pose, double standing_hip_height);

/// Returns the proportions of a moving body: the median over its frames of each limb's length and of the standing hip
/// height. There must be a frame.
BodyProportions MedianProportions(std::span<const BodyPose> poses);

/// Returns the body at rest: above the origin, facing +Z, with straight limbs, hanging arms, and soles on the floor.
BodyPose StandingPose(const BodyProportions& proportions);

/// Transfers the motions to a body of these proportions. Paper A's clips all show one character; recorded clips come
/// from many people, and a transition between two bodies would be visible at any pose.
///
/// Every limb keeps its direction and gets its new length. Travel and hip height are scaled with the legs. Then the
/// clips are shifted vertically until the lower foot is on or below the floor in 5 % of the frames. Clips with equal
/// leg lengths (to 0.1 mm, in the first frame) belong to one person and are shifted together: a person who sits in one
/// clip and sits down in another then sits equally high in both clips. If the new limb lengths put a clip's feet below
/// the floor, this clip is shifted separately. A limb of zero length in the source takes its parent limb's direction.
void PerformBy(const BodyProportions& proportions, std::span<BodyMotion> motions);
/// Returns copies of the motions, changed by PerformBy.
std::vector<BodyMotion> PerformedBy(const BodyProportions& proportions, std::span<const BodyMotion> motions);

}  // namespace etude
