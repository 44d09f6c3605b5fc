#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/limb_direction.h"
#include "engine/cameras/triangulation.h"

namespace etude {

/// A camera's sighting of a point with its accuracy.
struct InformedSighting {
  Sighting sighting;
  glm::dmat2 information{1};  ///< inverse covariance of the pixel, 1/px²
};

/// The normal equations of the sum of squares Σ rᵀ Λ r at one place, r the reprojection error and Λ its information:
/// the place's own information (its normal matrix), and the right side of the step to the minimum.
struct PointEquations {
  glm::dmat3 information{0};
  glm::dvec3 right{0};
};
/// Sums up the equations at `p_WQ`; nothing where a camera cannot show the place.
std::optional<PointEquations> PointEquationsAt(std::span<const InformedSighting> sightings, const glm::dvec3& p_WQ);

struct LikeliestPoint {
  glm::dvec3 position{0};     ///< p_WQ, metres
  glm::dmat3 information{0};  ///< inverse covariance, 1/m²
};

/// Finds the place of least Σ rᵀ Λ r, by Gauss–Newton steps from paper B's linear solution (`Triangulate`). Nothing
/// where that is none, or the steps leave what the cameras see.
std::optional<LikeliestPoint> TriangulateLikeliest(std::span<const InformedSighting> sightings);

/// Finds the sightings of one point that agree with each other *(ours)*: every two of them triangulate a point; with it
/// agree those that show it within `tolerance_px`. The set with the most weight counts, of equal ones the one whose
/// (weighted) root mean square distance from its point is least. All pairs are tried, so that no dice are needed: n
/// views cost n²/2 triangulations (the consensus of Fischler and Bolles 1981, without sampling). One outlier among
/// three is found only as far as it is off the other cameras' epipolar lines.
/// @param weights how sure each sighting is, above 0; none at all: all alike
/// @return their indices, ascending; all when there are fewer than three, or when no two meet in a point
std::vector<std::size_t> AgreeingViews(std::span<const Sighting> sightings, double tolerance_px,
                                       std::span<const double> weights = {});

/// Finds the sightings of a limb that agree about both ends of its strokes at once.
std::vector<std::size_t> AgreeingViews(std::span<const LimbSighting> sightings, double tolerance_px);

struct WeightedSighting {
  Sighting sighting;
  double weight = 1;  ///< how sure it is; at most 0: passed over
};

struct RobustOptions {
  /// A sighting further than this from the projected point is an outlier, pixels. Several times what the detector errs:
  /// at 20 pixels, 60.
  double outlier_px = 60;
};

struct RobustPoint {
  glm::dvec3 position{0};      ///< p_WQ, metres
  std::vector<bool> agrees{};  ///< of each sighting
  double residual_px = 0;      ///< weighted root mean square over those that agree
};

/// Triangulates the point that sightings agree on, where some of them may show something else *(ours)*: that of the
/// views which agree with each other (`AgreeingViews`, the surer ones counting more), of least Σ w · d², d being the
/// distance in the picture (`TriangulateLikeliest`); views that come within `outlier_px` of it, or leave that, are
/// taken in or left out, three times at most. Nothing when no two agree. Of two sightings, both must.
std::optional<RobustPoint> TriangulateRobustly(std::span<const WeightedSighting> sightings,
                                               const RobustOptions& options = {});

}  // namespace etude
