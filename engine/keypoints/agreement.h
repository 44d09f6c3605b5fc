#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/formats/trc.h"
#include "engine/keypoints/keypoint_motion.h"
#include "engine/motion/body.h"

namespace etude {

/// The places of landmarks as markers that carry their names; those never seen are left out.
MarkerMotion ToMarkers(std::span<const LandmarkPlaces> frames, double rate_hz);

/// The other way round; markers of other names are passed over.
std::vector<LandmarkPlaces> ToLandmarks(const MarkerMotion& markers);

/// The joints that landmarks tell of (`JointsOf`), and those of a motion, as markers that carry their roles' names.
MarkerMotion JointMarkers(std::span<const LandmarkPlaces> frames, double rate_hz);
MarkerMotion JointMarkers(const BodyMotion& motion);

/// How far two recordings of one marker are apart.
struct MarkerAgreement {
  std::string name;
  double median_mm = 0;
  double p95_mm = 0;
  std::size_t frames = 0;  ///< in which both have it
};

/// Marker by marker, those that both name, in the reference's order: frame by frame, as many as the shorter one has.
/// Distances between markers of one name in one frame; no alignment. A distance to a reference that was made of the
/// same keypoints is agreement, not error.
std::vector<MarkerAgreement> CompareMarkers(const MarkerMotion& motion, const MarkerMotion& reference);

/// Over all markers and frames at once.
MarkerAgreement CompareAllMarkers(const MarkerMotion& motion, const MarkerMotion& reference);

}  // namespace etude
