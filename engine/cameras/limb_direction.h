#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "engine/base/angles.h"
#include "engine/cameras/camera.h"

namespace etude {

/// A limb as drawn in one picture: the pixels of its start `a` and its end `b`.
struct PixelSegment {
  glm::dvec2 a{0};
  glm::dvec2 b{0};
};

/// A camera and the stroke of a limb in its picture.
struct LimbSighting {
  ProjectionMatrix matrix;
  PixelSegment stroke;
};

/// Returns the direction in which the camera sees `pixel`, in the world, away from the camera. It is the cross product
/// of the normals of two planes through the pixel and the camera's centre (paper B, equations 2.4 and 2.5), and is not
/// normalised.
glm::dvec3 ViewingRay(const ProjectionMatrix& matrix, const glm::dvec2& pixel);

/// The plane through a camera's centre and a stroke; it contains the limb.
struct StrokePlane {
  glm::dvec3 normal_W{0};  ///< unit normal, in the direction of ray(a) × ray(b)
  glm::dvec3 ray_a_W{0};   ///< unit vector from the camera through the stroke's start
  glm::dvec3 ray_b_W{0};   ///< unit vector from the camera through the stroke's end
  double length_px = 0;
};

/// Returns the plane of a stroke; nullopt if the stroke has no length, that is, at most 0.006 pixel at a focal length
/// of 600 pixels.
std::optional<StrokePlane> PlaneOf(const LimbSighting& sighting);

enum class DirectionStatus {
  kOk,
  /// Fewer than two strokes with a length, or all planes (nearly) parallel: the limb lies in a plane through all
  /// cameras.
  kIllConditioned,
};

struct LimbDirection {
  DirectionStatus status = DirectionStatus::kIllConditioned;
  glm::dvec3 direction{0};  ///< unit vector in the world, from a to b; only when kOk
  /// The angle between the two planes, in [0, π/2]; for more planes, the largest angle between any two. The error of
  /// the direction is about the angular error of the planes divided by sin(plane_angle).
  double plane_angle = 0;
};

/// Computes the direction of a limb seen by two or more cameras. Each stroke and its camera's centre span a plane with
/// unit normal N ~ ray(a) × ray(b) that contains the limb. The intersection of two planes is N₁ × N₂ (paper B, section
/// 2.3). *Ours*: for more planes, the direction is the unit vector d that minimises Σ (Nᵢ·d)²/εᵢ². Here εᵢ ~ |rayᵢ × d|
/// / (length of the stroke) is the error of Nᵢ·d caused by an error of one pixel at the stroke's ends; a near camera,
/// which shows the limb as a long stroke, therefore has more weight. εᵢ is computed with the d that results from equal
/// weights. Strokes without length are left out. The direction points from a to b in the pictures (ours; the paper does
/// not say). If pictures disagree about the sense of d, the pictures in which the limb is less
/// foreshortened have more weight.
/// @param min_plane_angle the result is ill-conditioned if no two planes differ by at least this angle, radians
LimbDirection ComputeLimbDirection(std::span<const LimbSighting> sightings, double min_plane_angle = Radians(3));

}  // namespace etude
