#include "engine/cameras/angle_axis.h"

#include <utility>

namespace etude {
namespace {

/// Returns the quaternion (w, v) of a rotation (Shoemake, "Quaternion Calculus and Fast Animation", SIGGRAPH 1987).
std::pair<double, glm::dvec3> ToQuaternion(const glm::dmat3& R) {
  const auto at = [&](int row, int column) { return R[column][row]; };
  const double trace = at(0, 0) + at(1, 1) + at(2, 2);
  if (trace >= 0) {
    const double root = std::sqrt(trace + 1.0), scale = 0.5 / root;
    return {0.5 * root, {(at(2, 1) - at(1, 2)) * scale, (at(0, 2) - at(2, 0)) * scale, (at(1, 0) - at(0, 1)) * scale}};
  }
  // Compute the largest element of v first, to avoid a division by a small number.
  int i = at(1, 1) > at(0, 0) ? 1 : 0;
  if (at(2, 2) > at(i, i)) i = 2;
  const int j = (i + 1) % 3, k = (j + 1) % 3;
  const double root = std::sqrt(at(i, i) - at(j, j) - at(k, k) + 1.0), scale = 0.5 / root;
  glm::dvec3 v;
  v[i] = 0.5 * root;
  v[j] = (at(j, i) + at(i, j)) * scale;
  v[k] = (at(k, i) + at(i, k)) * scale;
  return {(at(k, j) - at(j, k)) * scale, v};
}

}  // namespace

glm::dvec3 ToAngleAxis(const glm::dmat3& R) {
  const auto [cosine, v] = ToQuaternion(R);
  const double square = v.x * v.x + v.y * v.y + v.z * v.z;
  if (!(square > 0)) return 2.0 * v;
  const double sine = std::sqrt(square);
  // q and −q are the same rotation; choose the sign that gives the smaller angle.
  const double half = cosine < 0 ? std::atan2(-sine, -cosine) : std::atan2(sine, cosine);
  return v * (2.0 * half / sine);
}

glm::dmat3 FromAngleAxis(const glm::dvec3& v) {
  const double square = v.x * v.x + v.y * v.y + v.z * v.z;
  // The initialiser lists the matrix by columns.
  if (!(square > std::numeric_limits<double>::epsilon())) return {1, v.z, -v.y, -v.z, 1, v.x, v.y, -v.x, 1};
  const double angle = std::sqrt(square);
  const double x = v.x / angle, y = v.y / angle, z = v.z / angle;
  const double c = std::cos(angle), s = std::sin(angle), rest = 1.0 - c;
  return {c + x * x * rest,     z * s + x * y * rest,  -y * s + x * z * rest,  //
          x * y * rest - z * s, c + y * y * rest,      x * s + y * z * rest,   //
          y * s + x * z * rest, -x * s + y * z * rest, c + z * z * rest};
}

}  // namespace etude
