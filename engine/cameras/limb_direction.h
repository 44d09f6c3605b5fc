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

/// A camera and the stroke that its picture shows of a limb.
struct LimbSighting {
  ProjectionMatrix matrix;
  PixelSegment stroke;
};

/// Returns the direction in the world in which the camera sees `pixel`, pointing away from the camera: the cross
/// product of the two planes through that pixel (paper B, equations 2.4 and 2.5). Of any length.
glm::dvec3 ViewingRay(const ProjectionMatrix& matrix, const glm::dvec2& pixel);

/// The plane through a camera's centre and a stroke; the limb lies in it.
struct StrokePlane {
  glm::dvec3 normal_W{0};  ///< unit, ray(a) × ray(b)
  glm::dvec3 ray_a_W{0};   ///< unit, from the camera through the stroke's start
  glm::dvec3 ray_b_W{0};   ///< unit, through its end
  double length_px = 0;    ///< of the stroke
};

/// Returns the plane of a stroke; nothing for one without length, which is shorter than 0.01 pixel at a focal length of
/// 600.
std::optional<StrokePlane> PlaneOf(const LimbSighting& sighting);

enum class DirectionStatus {
  kOk,
  /// Fewer than two strokes that have a length, or all planes (nearly) parallel: a limb in a plane through all cameras.
  kIllConditioned,
};

struct LimbDirection {
  DirectionStatus status = DirectionStatus::kIllConditioned;
  glm::dvec3 direction{0};  ///< unit, in the world, from a to b; only when kOk
  /// The angle between the two planes, in [0, π/2]; of more planes, the largest between any two. An error of two
  /// strokes is magnified by 1/sin of it.
  double plane_angle = 0;
};

/// Computes the direction of a limb seen by two or more cameras. Each stroke and its camera's centre span a plane with
/// the unit normal N ~ ray(a) × ray(b), in which the limb lies. With two planes it lies along N₁ × N₂ (paper B, section
/// 2.3). *Ours*: with more, along the unit vector d with the smallest Σ (Nᵢ·d)²/εᵢ², where εᵢ ~ |rayᵢ × d| / length of
/// the stroke is what an error of so many pixels at its ends makes of Nᵢ·d: planes of strokes that are drawn long for
/// what they show of the limb weigh more, which are those of near cameras (d for the weights is that of equal ones).
/// Strokes without length are left out. The sign is such that the limb runs from a to b in the pictures (ours; the
/// paper is silent); where they disagree, those in which the limb is less foreshortened decide.
/// @param smallest_plane_angle ill-conditioned when no two planes are so far from parallel, radians
LimbDirection ComputeLimbDirection(std::span<const LimbSighting> sightings, double smallest_plane_angle = Radians(3));

}  // namespace etude
