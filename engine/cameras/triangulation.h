#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/cameras/camera.h"

namespace etude {

/// Where one camera saw a point.
struct Sighting {
  ProjectionMatrix matrix;
  glm::dvec2 pixel{0};
};

/// All places that one pixel can show.
struct SightLine {
  glm::dvec3 camera_W{0};     ///< the camera's centre, metres
  glm::dvec3 direction_W{0};  ///< unit, away from the camera
};

/// Nothing when the matrix has no centre (a camera at infinity) or a number is not finite.
std::optional<SightLine> SightLineOf(const Sighting& sighting);

/// Of all places on the line in front of the camera, the one nearest to the point at `p_WQ`.
glm::dvec3 NearestOn(const SightLine& line, const glm::dvec3& p_WQ);

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

/// *Ours*: the same, every row divided by the point's depth before its camera as well, so that what is minimised are
/// distances in pixels: a camera far away sees a point less exactly, and weighs less (iterated linear least squares,
/// Hartley and Sturm 1997, section 4.3; three rounds). Two equally far cameras give the point of `Triangulate`.
TriangulatedPoint TriangulateByPixels(std::span<const Sighting> sightings);

}  // namespace etude
