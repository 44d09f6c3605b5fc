#pragma once

#include <optional>
#include <span>

#include "engine/capture/adjust_take.h"
#include "engine/kinematics/body_tree.h"

namespace etude {

struct MeasureLengthsOptions {
  /// How many frames are used, spread evenly over those that show the most joints. Errors that last over frames are
  /// averaged by frames far apart, not by more of them.
  int frames = 12;
  MarkErrors marks;
};

/// The limb lengths of the person in the pictures (paper B, section 6.2.2, leaves them as future work): those with
/// which paper B's body explains the marks of a few frames best, each frame in a pose of its own (`AdjustBundle` over
/// lengths, poses and marks). Begins with the medians of the lengths between triangulated joints. Nothing when no frame
/// shows a body, or the outcome is no body.
/// @param measured the joints of every frame (`MeasureJoints`)
std::optional<LimbLengths> MeasureLengths(const MeasureInputs& pictures, std::span<const JointMeasurements> measured,
                                          const MeasureLengthsOptions& options = {});

}  // namespace etude
