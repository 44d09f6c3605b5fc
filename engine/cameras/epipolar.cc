#include "engine/cameras/epipolar.h"

#include <cmath>
#include <limits>

namespace etude {
namespace {

/// The inverse of the matrix's left square: from pixels to directions in the world.
glm::dmat3 DirectionsOf(const ProjectionMatrix& matrix) {
  const auto& h = matrix.h;
  return glm::inverse(
      glm::transpose(glm::dmat3(h[0][0], h[0][1], h[0][2], h[1][0], h[1][1], h[1][2], h[2][0], h[2][1], h[2][2])));
}

glm::dvec3 CentreOf(const ProjectionMatrix& matrix, const glm::dmat3& directions) {
  return -(directions * glm::dvec3(matrix.h[0][3], matrix.h[1][3], matrix.h[2][3]));
}

}  // namespace

std::optional<EpipolarGeometry> EpipolarGeometry::Of(const ProjectionMatrix& first, const ProjectionMatrix& second) {
  const glm::dmat3 from_a = DirectionsOf(first), from_b = DirectionsOf(second);
  const glm::dvec3 t = CentreOf(second, from_b) - CentreOf(first, from_a);
  const glm::dmat3 cross(glm::dvec3(0, t.z, -t.y), glm::dvec3(-t.z, 0, t.x), glm::dvec3(t.y, -t.x, 0));
  EpipolarGeometry geometry;
  geometry.f_ = glm::transpose(from_b) * cross * from_a;
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(glm::length(geometry.f_[i]))) return std::nullopt;
  }
  return geometry;
}

double EpipolarGeometry::DistancePx(const glm::dvec2& first, const glm::dvec2& second) const {
  const glm::dvec3 a(first, 1), b(second, 1), line_b = f_ * a, line_a = glm::transpose(f_) * b;
  const double gain = line_b.x * line_b.x + line_b.y * line_b.y + line_a.x * line_a.x + line_a.y * line_a.y;
  const double off = glm::dot(b, line_b);
  return gain > 0   ? off / std::sqrt(2 * gain)
         : off == 0 ? 0
                    : std::copysign(std::numeric_limits<double>::infinity(), off);
}

}  // namespace etude
