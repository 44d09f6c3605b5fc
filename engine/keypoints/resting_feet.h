#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/keypoints/keypoint_motion.h"

namespace etude {

/// The kinds of landmarks of a foot: ankle, heel, big toe, small toe.
constexpr std::size_t kFootKinds = 4;

/// Returns the height of a kind of landmark above the sole of a flat foot *(ours)*, in the unit of `stature`.
double AboveSole(std::size_t kind, double stature);

/// A place where a landmark of a foot rested for a fifth of a second or longer.
struct FootStay {
  glm::dvec3 place{0};
  std::size_t kind = 0;  ///< below kFootKinds
};

/// Returns the stays of all feet, the longest first, at most 200. A landmark rests while its speed is below a fifth of
/// the stature per second; a stay ends where it is farther than a fortieth of the stature
/// from its mean, and counts if its halves are at most 0.6 % of the stature apart: feet that slide do not rest.
/// @param stature in the points' unit
std::vector<FootStay> FeetAtRest(std::span<const LandmarkPositions> points, double rate_hz, double stature);

/// Returns the height along `up` of the floor under the feet: for each kind of landmark the mean of the stays within a
/// twentieth of the stature of the lowest tenth, less the landmark's height above the sole; of these the median, or the
/// lowest if they differ by more than a fortieth of the stature (the feet do not stand flat). 0 without a stay.
double FloorUnder(std::span<const FootStay> stays, const glm::dvec3& up, double stature);

}  // namespace etude
