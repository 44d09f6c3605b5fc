#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/formats/trc.h"
#include "engine/keypoints/keypoint_motion.h"
#include "engine/motion/body.h"

namespace etude {

/// Turns the places of landmarks into markers of their names; landmarks never seen are left out.
MarkerMotion ToMarkers(std::span<const LandmarkPlaces> frames, double rate_hz);

/// Turns markers into places of landmarks; markers of other names are passed over.
std::vector<LandmarkPlaces> ToLandmarks(const MarkerMotion& markers);

/// Returns the joints that landmarks determine (`JointsOf`), or those of a motion, as markers of their roles' names.
MarkerMotion JointMarkers(std::span<const LandmarkPlaces> frames, double rate_hz);
MarkerMotion JointMarkers(const BodyMotion& motion);

/// Two rates are one where they differ by less than this share: 29.97 and 30 frames a second.
constexpr double kOneRate = 0.002;

/// Resamples markers: frame k is at k / rate_hz seconds, on the straight line between the frames around it; nothing
/// where one of these is missing or the recording has ended. Of one rate (`kOneRate`) frames stay as they are.
MarkerMotion AtRate(MarkerMotion markers, double rate_hz);

/// The time of a reference beside a motion: the motion's frame k shows what the reference's frame
/// at + (1 + stretch) · k shows.
struct ReferenceClock {
  double at = 0, stretch = 0;
  /// The share of distances that are far, of frame for frame and of this clock: the mean of d² / (d² + s²), s = 3 cm.
  double before = 0, after = 0;
  /// Returns how far it leads away from frame for frame over that many frames, in the reference's frames.
  double DriftOver(std::size_t frames) const { return stretch * static_cast<double>(frames); }
};

/// Measures that time where both have markers of one name, to a five-hundredth of a frame: offsets of up to two
/// frames, drifts of up to three over half of the motion, and from there downhill. Nothing where no marker is in both.
std::optional<ReferenceClock> MeasureClock(const MarkerMotion& motion, const MarkerMotion& reference);

/// Returns the reference at the motion's frames, `frames` of them, straight between its own as `AtRate` does it.
MarkerMotion AtClock(const MarkerMotion& reference, const ReferenceClock& clock, std::size_t frames, double rate_hz);

/// The distance between two recordings of one marker.
struct MarkerAgreement {
  std::string name;
  double median_mm = 0;
  double p95_mm = 0;
  std::size_t frames = 0;  ///< in which both have it
};

/// Compares the markers that both name, one by one in the reference's order, over as many frames as the shorter motion
/// has. Distances between markers of one name in one frame; no alignment. A distance to a reference that was made of
/// the same keypoints is agreement, not error.
std::vector<MarkerAgreement> CompareMarkers(const MarkerMotion& motion, const MarkerMotion& reference);

/// Compares all markers and frames at once.
MarkerAgreement CompareAllMarkers(const MarkerMotion& motion, const MarkerMotion& reference);

}  // namespace etude
