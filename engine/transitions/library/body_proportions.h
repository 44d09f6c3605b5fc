#pragma once

#include <array>

#include "engine/motion/body.h"

namespace etude {

/// The body that performs all clips of a library.
struct Physique {
  /// Metres, by the limb's child joint; the hip centre's entry is 0.
  std::array<double, kRoleCount> limb_lengths{};
  double standing_hip_height = 0;  ///< metres, as `StandingHipHeight` reads it
};

/// A character with the proportions of `pose`, scaled to stand `standing_hip_height` metres at the hips.
/// `pose` must have legs.
Physique MakePhysique(const BodyPose& pose, double standing_hip_height);

/// The same dance, danced by `character`. Paper A's clips all belong to one character; real clips come
/// from many people, and a switch between two bodies would be seen whatever the pose.
///
/// Every limb keeps its direction and gets its new length; travel and hip height scale with the legs;
/// then the clip is set down, so that the lower foot is on or below the floor in 5 % of its frames. A
/// limb of zero length in the source follows its parent limb's direction.
BodyMotion PerformedBy(const Physique& character, const BodyMotion& motion);

}  // namespace etude
