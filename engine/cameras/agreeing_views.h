#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/cameras/limb_direction.h"
#include "engine/cameras/triangulation.h"

namespace etude {

/// Which sightings of one point agree with each other *(ours)*: every two of them triangulate a point; with it agree
/// those that show it within `tolerance_px`. The set with the most weight counts, of equal ones the one whose
/// (weighted) root mean square distance from its point is least. All pairs are tried, so that no dice are needed: n
/// views cost n²/2 triangulations (the consensus of Fischler and Bolles 1981, without sampling). One outlier among
/// three is found only as far as it is off the other cameras' epipolar lines.
/// @param weights how sure each sighting is, above 0; none at all: all alike
/// @return their indices, ascending; all when there are fewer than three, or when no two meet in a point
std::vector<std::size_t> AgreeingViews(std::span<const Sighting> sightings, double tolerance_px,
                                       std::span<const double> weights = {});

/// The same for a limb, told by both ends of its strokes at once.
std::vector<std::size_t> AgreeingViews(std::span<const LimbSighting> sightings, double tolerance_px);

}  // namespace etude
