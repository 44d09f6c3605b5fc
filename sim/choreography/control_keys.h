#pragma once

#include <cstddef>
#include <vector>

#include "engine/base/result.h"
#include "sim/choreography/controls.h"
#include "sim/choreography/periodic_curve.h"

namespace etude {

/// One authored pose of a move: the body at a beat.
struct PoseKey {
  double beat = 0;
  Controls controls;
  Ease ease = Ease::kSmooth;  ///< of the way to this pose from the one before
};

/// The keys of one control's curve through the poses of a loop of `beats` beats, each `beat_seconds` long. Two things
/// are not left to the poses, because nobody would author them well enough:
/// - a foot whose spot differs between two poses steps there: it is lifted, travels, and is down again before the pose;
/// - a pose with a jump is the top of a flight that obeys gravity: its height says how far
///   off take-off and landing are, and poses near it do not say how high the body is.
///   Before and after, the hips dip: the knees throw the
///   body up and catch it.
std::vector<PeriodicCurve::Key> KeysOf(const std::vector<PoseKey>& poses, std::size_t control, double beats,
                                       double beat_seconds);

/// Fails, at `place`, unless every jump, the knees' part included, lies within the loop and after the one before.
Result<void> CheckJumps(const std::vector<PoseKey>& poses, double beats, double beat_seconds, const Place& place);

}  // namespace etude
