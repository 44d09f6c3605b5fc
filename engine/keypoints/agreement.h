#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/formats/trc.h"
#include "engine/keypoints/keypoint_motion.h"
#include "engine/motion/body.h"

namespace etude {

/// Turns the positions of landmarks into markers with the landmarks' names; landmarks that are never seen are left out.
MarkerMotion ToMarkers(std::span<const LandmarkPositions> frames, double rate_hz);

/// Turns markers into positions of landmarks; markers of other names are ignored.
std::vector<LandmarkPositions> ToLandmarks(const MarkerMotion& markers);

/// Returns the joints that landmarks determine (`JointsOf`), or the joints of a motion, as markers named after their
/// roles.
MarkerMotion JointMarkers(std::span<const LandmarkPositions> frames, double rate_hz);
MarkerMotion JointMarkers(const BodyMotion& motion);

/// Two frame rates are treated as equal if their relative difference is at most this, for example 29.97 and 30 Hz.
constexpr double kSameRateTolerance = 0.002;

/// Resamples markers by linear interpolation: frame k is at k / rate_hz seconds. A marker is nullopt where a
/// neighbouring frame lacks it or the recording has ended. If the rates are equal (`kSameRateTolerance`) the frames are
/// unchanged.
MarkerMotion AtRate(MarkerMotion markers, double rate_hz);

/// The time of a reference recording relative to a motion: frame k of the motion corresponds to frame
/// at + (1 + stretch) · k of the reference.
struct ReferenceClock {
  double at = 0, stretch = 0;
  /// The mean loss d² / (d² + s²) of the distances d between the two recordings, with s = 3 cm. `before` compares
  /// frames with equal numbers; `after` compares the frames that this clock assigns to each other.
  double before = 0, after = 0;
  /// Returns the drift of the clock over `frames` frames, in frames of the reference.
  double DriftOver(std::size_t frames) const { return stretch * static_cast<double>(frames); }
};

/// Estimates the clock from the markers that both recordings contain, to 1/500 of a frame. A grid search over offsets
/// of up to two frames, and over drifts of up to three frames over half of the motion, is followed by a local search.
/// Returns nullopt if the recordings have too few markers in common.
std::optional<ReferenceClock> MeasureClock(const MarkerMotion& motion, const MarkerMotion& reference);

/// Returns `frames` frames of the reference at the times of the motion's frames, interpolated as by `AtRate`.
MarkerMotion AtClock(const MarkerMotion& reference, const ReferenceClock& clock, std::size_t frames, double rate_hz);

/// The distance between two recordings of one marker.
struct MarkerAgreement {
  std::string name;
  double median_mm = 0;
  double p95_mm = 0;
  std::size_t frames = 0;  ///< number of frames in which both recordings contain the marker
};

/// Compares the markers that both recordings contain, in the reference's order, over the frames of the shorter
/// recording. Distances are between markers of the same name in frames of the same number, without alignment. If the
/// reference was made from the same keypoints, the distance measures agreement, not error.
std::vector<MarkerAgreement> CompareMarkers(const MarkerMotion& motion, const MarkerMotion& reference);

/// Returns the agreement over all markers and frames together.
MarkerAgreement CompareAllMarkers(const MarkerMotion& motion, const MarkerMotion& reference);

}  // namespace etude
