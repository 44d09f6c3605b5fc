#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/limb_direction.h"
#include "engine/cameras/triangulation.h"

namespace etude {

/// A sighting of a point, and the accuracy of its pixel.
struct InformedSighting {
  Sighting sighting;
  glm::dmat2 information{1};  ///< inverse covariance of the pixel, 1/px²
};

/// The normal equations of Σ rᵀ Λ r at one position, where r is the reprojection error and Λ the information of each
/// sighting. `information` is the normal matrix, which is the information of the position; `right` is the right-hand
/// side of the Gauss–Newton step.
struct PointEquations {
  glm::dmat3 information{0};
  glm::dvec3 right{0};
};
/// Sums up the equations at `p_WQ`; returns nullopt if a camera cannot show that position.
std::optional<PointEquations> PointEquationsAt(std::span<const InformedSighting> sightings, const glm::dvec3& p_WQ);

struct LikeliestPoint {
  glm::dvec3 position{0};     ///< p_WQ, metres
  glm::dmat3 information{0};  ///< inverse covariance of the position, 1/m²
};

/// Finds the position that minimises Σ rᵀ Λ r, by five Gauss–Newton steps from paper B's linear solution
/// (`Triangulate`). Returns nullopt if the linear solution fails, or if a step leaves the space in front of the
/// cameras.
std::optional<LikeliestPoint> TriangulateLikeliest(std::span<const InformedSighting> sightings);

/// Finds the sightings of one point that agree with each other *(ours)*. Every pair of sightings triangulates a point;
/// the sightings within `tolerance_px` of the point's projections agree with the pair. Returns the agreeing set with
/// the largest total weight; among sets of equal weight, the one with the smallest (weighted) mean square distance from
/// its point. This is the consensus of Fischler and Bolles (1981) without sampling: all pairs are tried, so no random
/// numbers are needed, and n views cost n²/2 triangulations. With three sightings, one outlier can be detected only by
/// its distance from the epipolar lines of the other two.
/// @param weights the confidence of each sighting, above 0; empty: all equal
/// @return indices of the agreeing sightings, ascending; all indices if there are fewer than three, or if no pair gives
/// a point
std::vector<std::size_t> AgreeingViews(std::span<const Sighting> sightings, double tolerance_px,
                                       std::span<const double> weights = {});

/// Finds the agreeing sightings of a limb. A sighting agrees only if the start and the end of its stroke agree.
std::vector<std::size_t> AgreeingViews(std::span<const LimbSighting> sightings, double tolerance_px);

struct WeightedSighting {
  Sighting sighting;
  double weight = 1;  ///< confidence; sightings of weight at most 0 are ignored
};

struct RobustOptions {
  /// A sighting farther than this from the projected point is an outlier, pixels. Choose several times the detector's
  /// error: 60 for an error of 20 pixels.
  double outlier_px = 60;
};

struct RobustPoint {
  glm::dvec3 position{0};      ///< p_WQ, metres
  std::vector<bool> agrees{};  ///< for each sighting: true if it is not an outlier
  double residual_px = 0;      ///< weighted root mean square distance of the agreeing sightings
};

/// Triangulates a point from sightings of which some may be outliers *(ours)*. The first set of sightings is the one of
/// `AgreeingViews` (weighted). The position minimises Σ w · d² over the set, where d is the distance in the picture
/// (`TriangulateLikeliest`). Then the set becomes all sightings within `outlier_px` of the position's projections.
/// These two steps are repeated until the set no longer changes, at most twenty times. The position always belongs to
/// the set `agrees`. Returns nullopt if fewer than two sightings agree.
std::optional<RobustPoint> TriangulateRobustly(std::span<const WeightedSighting> sightings,
                                               const RobustOptions& options = {});

}  // namespace etude
