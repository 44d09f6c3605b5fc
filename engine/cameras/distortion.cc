#include "engine/cameras/distortion.h"

namespace etude {
namespace {

/// The derivatives of (x', y') by x (first column) and by y.
glm::dmat2 JacobianOf(const Distortion& d, const glm::dvec2& ray) {
  const double x = ray.x, y = ray.y, r2 = x * x + y * y;
  const double gain = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  const double slope = 2 * (d.k1 + r2 * (2 * d.k2 + r2 * 3 * d.k3));  // of `gain`, by r², twice
  const double mixed = x * y * slope + 2 * d.p1 * x + 2 * d.p2 * y;
  return {gain + x * x * slope + 2 * d.p1 * y + 6 * d.p2 * x, mixed, mixed,
          gain + y * y * slope + 6 * d.p1 * y + 2 * d.p2 * x};
}

}  // namespace

glm::dvec2 Distort(const Distortion& d, const glm::dvec2& ray) {
  const double x = ray.x, y = ray.y, r2 = x * x + y * y;
  const double gain = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  return {x * gain + 2 * d.p1 * x * y + d.p2 * (r2 + 2 * x * x), y * gain + d.p1 * (r2 + 2 * y * y) + 2 * d.p2 * x * y};
}

std::optional<glm::dvec2> Undistort(const Distortion& distortion, const glm::dvec2& distorted) {
  if (distortion.IsNone()) return distorted;
  constexpr int kMostSteps = 30;
  constexpr double kCloseEnough = 1e-12;
  glm::dvec2 ray = distorted;
  for (int step = 0; step < kMostSteps; ++step) {
    const glm::dmat2 jacobian = JacobianOf(distortion, ray);
    // Where the determinant turns negative, the picture folds back: what lies there is no solution.
    if (!(glm::determinant(jacobian) > 0) || !(jacobian[0][0] > 0)) return std::nullopt;
    const glm::dvec2 missing = distorted - Distort(distortion, ray);
    ray += glm::inverse(jacobian) * missing;
    if (glm::length(missing) < kCloseEnough) return ray;
  }
  return std::nullopt;
}

}  // namespace etude
