#pragma once

#include <glm/glm.hpp>

#include "engine/base/angles.h"
#include "engine/cameras/camera.h"

namespace etude {

/// A limb as drawn in one picture: two pixels on it, in the sense from its start to its end.
struct PixelSegment {
  glm::dvec2 a{0};
  glm::dvec2 b{0};
};

/// The direction in which the camera sees `pixel`, pointing away from the camera: the cross product of
/// the two planes through that pixel (paper B, equations 2.4 and 2.5). Of any length.
glm::dvec3 ViewingRay(const ProjectionMatrix& matrix, const glm::dvec2& pixel);

enum class DirectionStatus {
  kOk,
  kIllConditioned,  ///< a stroke without length, or planes (nearly) parallel: limb in a plane through both cameras
};

struct LimbDirection {
  DirectionStatus status = DirectionStatus::kIllConditioned;
  glm::dvec3 direction{0};  ///< unit, in the world, from a to b; only when kOk
  /// The angle between the two planes, in [0, π/2]: an error of the strokes is magnified by 1/sin of it.
  double plane_angle = 0;
};

/// The direction of a limb seen by two cameras (paper B, section 2.3): each stroke and its camera's
/// centre span a plane with the normal N = ray(a) × ray(b), and the limb lies along N₁ × N₂. Its sign is
/// such that it runs from a to b in the pictures (ours; the paper is silent); where they disagree, the
/// picture in which the limb is less foreshortened decides.
/// @param smallest_plane_angle planes closer to parallel than this are ill-conditioned, radians
LimbDirection ComputeLimbDirection(const ProjectionMatrix& matrix1, const PixelSegment& stroke1,
                                   const ProjectionMatrix& matrix2, const PixelSegment& stroke2,
                                   double smallest_plane_angle = Radians(3));

}  // namespace etude
