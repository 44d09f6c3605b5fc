#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/keypoints/keypoint_motion.h"

namespace etude {

/// The kinds of landmarks of a foot: ankle, heel, big toe, small toe.
constexpr std::size_t kFootKinds = 4;

/// Returns how high a kind of landmark is above the sole of a flat foot *(ours)*, in the unit of `stature`.
double AboveSole(std::size_t kind, double stature);

/// A period in which a landmark of a foot rested for at least a fifth of a second.
struct FootStay {
  glm::dvec3 place{0};
  std::size_t kind = 0;  ///< index of the landmark's kind, below kFootKinds
};

/// Returns the stays of all feet, the longest first, at most 200. A landmark rests while its speed is below a fifth of
/// the stature per second; a stay ends when the landmark is farther than 1/40 of the stature from the stay's mean. A
/// stay is used only if the means of its two halves are at most 0.6 % of the stature apart, because a sliding foot does
/// not rest.
/// @param stature the stature in the points' unit
std::vector<FootStay> FeetAtRest(std::span<const LandmarkPositions> points, double rate_hz, double stature);

/// Returns the height along `up` of the floor under the feet. Each kind of landmark gives one height: the mean height
/// of the kind's low stays (at most 1/20 of the stature above the 10th percentile of the kind's stays), minus the
/// kind's height above the sole. The result is the median of these heights, or the lowest of them if they differ by
/// more than 1/40 of the stature (then the feet do not stand flat). Returns 0 if there is no stay.
double FloorUnder(std::span<const FootStay> stays, const glm::dvec3& up, double stature);

}  // namespace etude
