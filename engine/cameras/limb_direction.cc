#include "engine/cameras/limb_direction.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

// Two rays this close to each other span no plane: 0.01 pixel at a focal length of 600.
constexpr double kSamePixel = 1e-5;

struct LimbPlane {
  glm::dvec3 ray_a{0};   // unit
  glm::dvec3 normal{0};  // unit, ray_a × ray_b; zero when the stroke has no length
};

LimbPlane PlaneOf(const ProjectionMatrix& matrix, const PixelSegment& stroke) {
  const glm::dvec3 a = glm::normalize(ViewingRay(matrix, stroke.a));
  const glm::dvec3 b = glm::normalize(ViewingRay(matrix, stroke.b));
  const glm::dvec3 normal = glm::cross(a, b);
  const double length = glm::length(normal);
  if (!(length > kSamePixel)) return {};  // also catches NaN
  return {a, normal / length};
}

// How far `direction` leads from ray a towards ray b, in [−1, 1]. Within the plane, direction =
// α·a + β·b; a point on ray a moving along it is seen moving towards b exactly when β > 0.
double Sense(const LimbPlane& plane, const glm::dvec3& direction) {
  return glm::dot(glm::cross(plane.ray_a, direction), plane.normal);
}

}  // namespace

glm::dvec3 ViewingRay(const ProjectionMatrix& matrix, const glm::dvec2& pixel) {
  const auto& h = matrix.h;
  const glm::dvec3 h1(h[0][0], h[0][1], h[0][2]), h2(h[1][0], h[1][1], h[1][2]), h3(h[2][0], h[2][1], h[2][2]);
  const glm::dvec3 ray = glm::cross(h1 - pixel.x * h3, h2 - pixel.y * h3);
  return glm::dot(h3, ray) < 0 ? -ray : ray;  // w must grow along the ray
}

LimbDirection ComputeLimbDirection(const ProjectionMatrix& matrix1, const PixelSegment& stroke1,
                                   const ProjectionMatrix& matrix2, const PixelSegment& stroke2,
                                   double smallest_plane_angle) {
  const LimbPlane plane1 = PlaneOf(matrix1, stroke1);
  const LimbPlane plane2 = PlaneOf(matrix2, stroke2);
  LimbDirection limb;
  if (plane1.normal == glm::dvec3(0) || plane2.normal == glm::dvec3(0)) return limb;
  const double between_normals = AngleBetween(plane1.normal, plane2.normal);
  limb.plane_angle = std::min(between_normals, kPi - between_normals);
  if (limb.plane_angle < std::max(smallest_plane_angle, kSamePixel)) return limb;

  const glm::dvec3 along = glm::normalize(glm::cross(plane1.normal, plane2.normal));
  const bool reversed = Sense(plane1, along) + Sense(plane2, along) < 0;
  return {DirectionStatus::kOk, reversed ? -along : along, limb.plane_angle};
}

}  // namespace etude
