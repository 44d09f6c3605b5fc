#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace etude {

/// What a lens does to straight lines: Brown and Conrady's model with OpenCV's coefficients and signs. Of a ray through
/// (x, y, 1) in the camera's frame, with r² = x² + y²,
///
///     x' = x (1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 x y + p2 (r² + 2 x²)
///     y' = y (1 + k1 r² + k2 r⁴ + k3 r⁶) + p1 (r² + 2 y²) + 2 p2 x y
///
/// is what the intrinsics turn into a pixel. All zero: a pinhole.
struct Distortion {
  double k1 = 0, k2 = 0;  ///< radial; k1 < 0 is a barrel
  double p1 = 0, p2 = 0;  ///< tangential: a lens that is not parallel to the sensor
  double k3 = 0;          ///< radial, the sixth power

  bool IsNone() const { return *this == Distortion{}; }
  friend bool operator==(const Distortion&, const Distortion&) = default;
};

/// (x', y') of (x, y).
glm::dvec2 Distort(const Distortion& distortion, const glm::dvec2& ray);

/// The (x, y) nearest to the axis that `Distort` takes to `distorted`, by Newton's method to 1e-12; nothing when there
/// is none: beyond the radius at which the model turns back on itself, it shows no lens.
std::optional<glm::dvec2> Undistort(const Distortion& distortion, const glm::dvec2& distorted);

}  // namespace etude
