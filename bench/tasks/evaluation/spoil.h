#pragma once

#include "engine/motion/raw_motion.h"

namespace etude {

/// The faults that are added to a truth, in this order, to test metrics on an answer whose faults are known. A fault of
/// 0 changes nothing.
struct Spoiler {
  double noisy_mm = 0;        ///< standard deviation of white noise on each axis of each joint
  double smoothed_ms = 0;     ///< length of a centred moving mean
  double faded_percent = 0;   ///< reduction of every joint's distance from its mean position
  double scaled_percent = 0;  ///< enlargement about the world's origin
  double moved_cm = 0;        ///< shift along the world's X axis
  double lifted_cm = 0;
  double gliding_cm_s = 0;    ///< speed along the world's X axis
  double feet_locked_cm = 0;  ///< ankles and toes are held at rest while the toes are below this height
  double mirrored_share = 0;  ///< share of the take, at its end, in which left and right are exchanged
  int kept_frames = 1;        ///< n, if only every n-th frame is kept, with linear interpolation in between
  double late_ms = 0;         ///< delay of the motion; the first pose is held until the motion begins
  double frozen_share = 0;    ///< share of the take, at its end, in which the body stands still
  double hidden_percent = 0;  ///< share of all joints that are hidden; these have the largest errors (HideWorst)

  bool operator==(const Spoiler&) const = default;
};

/// Returns a copy of a truth with these faults; HideWorst hides joints later. The noise depends on `seed_name` alone.
/// Rotations get the faults, too. Noise of 10 mm, for example, turns each joint by 1.9° (standard deviation) about
/// each axis, because such noise at both ends of a limb of 42 cm turns the limb by that angle.
RawMotion Spoilt(const RawMotion& truth, const Spoiler& spoiler, const std::string& seed_name);

}  // namespace etude
