#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>

namespace etude {

// Rotations by Rodrigues' vector: the axis times the angle in radians. Ceres has these functions, too, but its rounding
// differs between versions (2.2 uses hypot instead of sqrt), and a fit of only a few steps amplifies the difference.

/// Returns the point `p` rotated by Rodrigues' vector `v`: R(v) p. `T` is double or an automatic-differentiation type,
/// such as Ceres's Jet.
template <typename T>
std::array<T, 3> RotateByAngleAxis(const T* v, const std::array<T, 3>& p) {
  using std::cos, std::sin, std::sqrt;
  const T square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  // For an angle near zero, use the first-order form: it is exact to rounding there, and the square root has no
  // derivative at zero.
  if (!(square > T(std::numeric_limits<double>::epsilon()))) {
    return {p[0] + (v[1] * p[2] - v[2] * p[1]), p[1] + (v[2] * p[0] - v[0] * p[2]), p[2] + (v[0] * p[1] - v[1] * p[0])};
  }
  const T angle = sqrt(square);
  const T cosine = cos(angle), sine = sin(angle), inverse = T(1.0) / angle;
  const T w[3] = {v[0] * inverse, v[1] * inverse, v[2] * inverse};
  const T cross[3] = {w[1] * p[2] - w[2] * p[1], w[2] * p[0] - w[0] * p[2], w[0] * p[1] - w[1] * p[0]};
  const T along = (w[0] * p[0] + w[1] * p[1] + w[2] * p[2]) * (T(1.0) - cosine);
  return {p[0] * cosine + cross[0] * sine + w[0] * along, p[1] * cosine + cross[1] * sine + w[1] * along,
          p[2] * cosine + cross[2] * sine + w[2] * along};
}

/// Returns Rodrigues' vector v of a rotation: R(v) = R and |v| ≤ π.
glm::dvec3 ToAngleAxis(const glm::dmat3& R);

/// Returns the rotation matrix R(v) of Rodrigues' vector `v`.
glm::dmat3 FromAngleAxis(const glm::dvec3& v);

}  // namespace etude
