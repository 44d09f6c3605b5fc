#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/capture/measure_frames.h"
#include "engine/kinematics/limb_lengths.h"

namespace etude {

struct GapOptions {
  /// A measurement is used at most this many frames before and after its own frame. 15 frames are half a second at 30
  /// Hz; after a longer time a limb can be anywhere. Scale this number with the frame rate. If only every n-th frame is
  /// marked, set it to at least n.
  int max_gap = 15;
  /// The standard deviation of a stroke's end, pixels. Only its ratio to `turn_per_frame` matters, and only for limbs
  /// whose direction cannot be computed from their strokes alone.
  double mark_error_px = 2;
  /// The standard deviation of a limb's rotation away from its direction in the nearest measured frame, radians per
  /// frame: 3° at 30 Hz *(ours)*.
  double turn_per_frame = Radians(3);
};

/// Completes every frame from the nearest measured frames before and after, separately for each quantity *(ours)*:
/// directions along the great circle (slerp), points linearly. Before the first and after the last measurement the
/// value is constant. A partial measurement of the frame itself is combined with the filled value b *(ours)*:
/// - An end effector that only one camera sees is placed at the point of its sight line nearest to b; without b, the
///   end effector is lacking.
/// - A limb that lies in planes with unit normals Nᵢ has the direction d that minimises
///     Σ (Nᵢ·d)²/εᵢ² + |d − b|²/τ²,   εᵢ = max(1°, √2 · `mark_error_px` / length of the stroke · |rayᵢ × b|).
///   τ is `turn_per_frame` times the number of frames to the nearest measurement. εᵢ is the error of Nᵢ·b that the
///   marks' errors cause; rayᵢ is the unit vector from the camera towards the stroke's middle. Nearly parallel planes
///   thus determine part of the direction; the neighbouring frames determine the rest. Without b, the limb is assumed
///   not to be foreshortened: its direction is normal to the mean line of sight of its pictures.
/// A quantity that is not seen in the frame and was not measured within `max_gap` frames is marked as lacking
/// (`LimbObservation::lacks_end`); a frame that lacks everything is empty.
std::vector<std::optional<LimbObservation>> InterpolateGaps(std::span<const FrameMeasurement> frames,
                                                            const GapOptions& options = {});

/// Completes the last frame from the frames before it, as a live system must. Frames that are more than `max_gap`
/// frames earlier have no effect.
std::optional<LimbObservation> ExtrapolateLast(std::span<const FrameMeasurement> frames,
                                               const GapOptions& options = {});

}  // namespace etude
