#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "engine/cameras/camera.h"

namespace etude {

/// What two cameras must agree on about any point, whatever its depth: bᵀ F a = 0 for its pixels a in the first and b
/// in the second picture.
class EpipolarGeometry {
 public:
  /// Nothing when a matrix has no centre (a camera at infinity).
  static std::optional<EpipolarGeometry> Of(const ProjectionMatrix& first, const ProjectionMatrix& second);

  /// By how many pixels two sightings must move to show one point, root mean square over the two pictures, to first
  /// order (Sampson's distance; Hartley and Zisserman, section 11.4.3). No point need be triangulated. Its sign tells
  /// on which side of the other's line each is.
  double DistancePx(const glm::dvec2& first, const glm::dvec2& second) const;

 private:
  glm::dmat3 f_{0};
};

}  // namespace etude
