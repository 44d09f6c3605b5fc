#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/cameras/triangulation.h"

namespace etude {

/// Where one camera saw a point, and how exactly.
struct InformedSighting {
  Sighting sighting;
  glm::dmat2 information{1};  ///< inverse covariance of the pixel, 1/px²
};

/// The sum of squares Σ rᵀ Λ r about one place, r the reprojection error and Λ its information: the place's own
/// information (its normal matrix), and the right side of the step to the minimum.
struct PointEquations {
  glm::dmat3 information{0};
  glm::dvec3 right{0};
};
/// Nothing where a camera cannot show the place.
std::optional<PointEquations> PointEquationsAt(std::span<const InformedSighting> sightings, const glm::dvec3& p_WQ);

struct LikeliestPoint {
  glm::dvec3 position{0};     ///< p_WQ, metres
  glm::dmat3 information{0};  ///< inverse covariance, 1/m²
};

/// The place of least Σ rᵀ Λ r, by Gauss–Newton steps from paper B's linear solution (`Triangulate`). Nothing where
/// that is none, or the steps leave what the cameras see.
std::optional<LikeliestPoint> TriangulateLikeliest(std::span<const InformedSighting> sightings);

}  // namespace etude
