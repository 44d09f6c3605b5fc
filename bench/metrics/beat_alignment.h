#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/metrics/evaluation.h"

namespace etude {

/// Returns the times of the motion beats of BeatAlignmentOfMusic, seconds; none if a joint is not seen throughout.
std::vector<double> MotionBeats(const PointTracks& found, double rate_hz);

/// Returns the mean over *music* beats of exp(−d² / 18), as Bailando's code computes it. d is the distance in frames
/// from a music beat to the nearest motion beat. Motion beats are the strict minima of the joints' mean speed, smoothed
/// by a Gaussian with a standard deviation of 5 frames. Beats are rounded to whole frames. Returns nothing if the
/// motion contains no music beat or no motion beat, or if a joint is not seen throughout.
std::optional<double> BeatAlignmentOfMusic(const PointTracks& found, double rate_hz, std::span<const double> beats_s);

/// Returns the mean over *motion* beats of exp(−d² / 18), as mint's code (AIST++) computes it. d is the distance in
/// frames from a motion beat to the nearest music beat. Motion beats are the frames in which the joints' summed speed
/// is lower than in each of the ten frames on either side, or in each frame of a side that has fewer. Returns nothing
/// in the same cases as BeatAlignmentOfMusic.
std::optional<double> BeatAlignmentOfMotion(const PointTracks& found, double rate_hz, std::span<const double> beats_s);

}  // namespace etude
