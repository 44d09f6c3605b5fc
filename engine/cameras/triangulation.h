#pragma once

#include <glm/glm.hpp>
#include <span>

#include "engine/cameras/camera.h"

namespace etude {

/// Where one camera saw a point.
struct Sighting {
  ProjectionMatrix matrix;
  glm::dvec2 pixel{0};
};

enum class PointStatus {
  kOk,
  kTooFewViews,     ///< fewer than two sightings
  kIllConditioned,  ///< the viewing rays are (nearly) parallel, or the sightings are not finite
};

struct TriangulatedPoint {
  PointStatus status = PointStatus::kTooFewViews;
  glm::dvec3 position{0};  ///< p_WQ, metres; only when kOk
  double residual_px = 0;  ///< root mean square reprojection distance over the sightings
};

/// The point Q seen by two or more cameras (paper B, section 2.4): each sighting gives two linear
/// equations, and p_WQ = V = (MᵀM)⁻¹ Mᵀb. The rows are divided by |h₃|, so that the arbitrary scale of an H
/// does not weigh its camera. (The paper prints h₁₄ for h₂₄ in the v rows: misprint.)
TriangulatedPoint Triangulate(std::span<const Sighting> sightings);

}  // namespace etude
