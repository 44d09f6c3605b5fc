#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/capture/measure_frames.h"
#include "engine/kinematics/limb_lengths.h"

namespace etude {

struct BridgeOptions {
  /// The number of frames that a measurement is used before and after its own. 15 is half a second at 30 Hz, after
  /// which a performer's limb may be anywhere. Scale it with the rate; when only every n-th frame is marked, make it n
  /// at least.
  int longest_gap = 15;
  /// The standard deviation of a stroke's end, pixels. Only its ratio to the next one counts, and only for limbs whose
  /// strokes alone give no direction.
  double mark_error_px = 2;
  /// The standard deviation of a limb's turn away from its neighbours' direction, radians per frame from the nearest
  /// one: 3° at 30 Hz *(ours)*.
  double turn_per_frame = Radians(3);
};

/// Completes every frame from the nearest measured ones before and after it, each quantity by itself (ours): directions
/// along the great circle (slerp), points straight; before the first and after the last measured one that one is
/// held. What a frame shows itself of such a quantity is kept *(ours)*: with b the bridged value,
/// - an end seen by one camera is the point of its sight line nearest to b; without b it is lacking;
/// - a limb that lies in the planes with unit normals Nᵢ has the direction of the d that minimises
///   Σ (Nᵢ·d)²/εᵢ² + |d − b|²/τ², where τ is `turn_per_frame` times the frames to the nearest measurement and
///   εᵢ = √2 · `mark_error_px` / length of the stroke · |ray × b|, 1° at least, is what the marks' error makes of Nᵢ·b:
///   nearly parallel planes settle what they can, the neighbours the rest. Without b it lies across its pictures' mean
///   line of sight: the limb is taken for unforeshortened.
/// What was not measured within `longest_gap` frames before or after, and is not seen at all, is lacking
/// (`LimbObservation::lacks_end`); a frame that lacks everything is empty.
std::vector<std::optional<LimbObservation>> BridgeGaps(std::span<const FrameMeasurement> frames,
                                                       const BridgeOptions& options = {});

/// Completes the last of these frames from those before it alone, which is what a live system knows. Frames more than
/// `longest_gap` before it change nothing.
std::optional<LimbObservation> BridgeLast(std::span<const FrameMeasurement> frames, const BridgeOptions& options = {});

}  // namespace etude
