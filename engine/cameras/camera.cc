#include "engine/cameras/camera.h"

#include <cassert>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

/// Returns the Jacobian of the model with five coefficients: the derivatives of (x', y') with respect to x (first
/// column) and y.
glm::dmat2 BrownJacobian(const Distortion& d, const glm::dvec2& ray) {
  const double x = ray.x, y = ray.y, r2 = x * x + y * y;
  const double gain = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  // Twice the derivative of `gain` with respect to r².
  const double slope = 2 * (d.k1 + r2 * (2 * d.k2 + r2 * 3 * d.k3));
  const double mixed = x * y * slope + 2 * d.p1 * x + 2 * d.p2 * y;
  return {gain + x * x * slope + 2 * d.p1 * y + 6 * d.p2 * x, mixed, mixed,
          gain + y * y * slope + 6 * d.p1 * y + 2 * d.p2 * x};
}

glm::dvec2 Brown(const Distortion& d, const glm::dvec2& ray) {
  const double x = ray.x, y = ray.y, r2 = x * x + y * y;
  const double gain = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  return {x * gain + 2 * d.p1 * x * y + d.p2 * (r2 + 2 * x * x), y * gain + d.p1 * (r2 + 2 * y * y) + 2 * d.p2 * x * y};
}

bool HasFiveCoefficients(const Distortion& d) {
  return !d.is_fisheye && d == Distortion{.k1 = d.k1, .k2 = d.k2, .p1 = d.p1, .p2 = d.p2, .k3 = d.k3};
}

/// Returns the homography from an upright sensor to a tilted one.
glm::dmat3 TiltOf(double tau_x, double tau_y) {
  const double cx = std::cos(tau_x), sx = std::sin(tau_x), cy = std::cos(tau_y), sy = std::sin(tau_y);
  const glm::dmat3 about_x(1, 0, 0, 0, cx, -sx, 0, sx, cx), about_y(cy, 0, sy, 0, 1, 0, -sy, 0, cy);
  const glm::dmat3 R = about_y * about_x;
  return glm::dmat3(R[2][2], 0, 0, 0, R[2][2], 0, -R[2][0], -R[2][1], 1) * R;
}

/// The model of Brown and Conrady with all fourteen coefficients.
glm::dvec2 FullBrown(const Distortion& d, const glm::dvec2& ray) {
  const double r2 = glm::dot(ray, ray);
  const double gain = (1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3))) / (1 + r2 * (d.k4 + r2 * (d.k5 + r2 * d.k6)));
  glm::dvec2 out = gain * ray;
  out.x += 2 * d.p1 * ray.x * ray.y + d.p2 * (r2 + 2 * ray.x * ray.x) + r2 * (d.s1 + r2 * d.s2);
  out.y += d.p1 * (r2 + 2 * ray.y * ray.y) + 2 * d.p2 * ray.x * ray.y + r2 * (d.s3 + r2 * d.s4);
  if (d.tau_x == 0 && d.tau_y == 0) return out;
  const glm::dvec3 tilted = TiltOf(d.tau_x, d.tau_y) * glm::dvec3(out, 1);
  return glm::dvec2(tilted) / tilted.z;
}

double FisheyeRadius(const Distortion& d, double angle) {
  const double a2 = angle * angle;
  return angle * (1 + a2 * (d.k1 + a2 * (d.k2 + a2 * (d.k3 + a2 * d.k4))));
}

double FisheyeSlope(const Distortion& d, double angle) {
  const double a2 = angle * angle;
  return 1 + a2 * (3 * d.k1 + a2 * (5 * d.k2 + a2 * (7 * d.k3 + a2 * 9 * d.k4)));
}

constexpr int kMaxSteps = 30;
constexpr double kCloseEnough = 1e-12;

/// Returns the ray in front of the camera that a fisheye shows at `distorted`.
std::optional<glm::dvec2> UndistortFisheye(const Distortion& d, const glm::dvec2& distorted) {
  const double wanted = glm::length(distorted);
  if (wanted == 0) return distorted;
  constexpr double kWidest = 0.4999 * kPi;
  double angle = std::min(wanted, kWidest);
  for (int step = 0; step < kMaxSteps; ++step) {
    const double slope = FisheyeSlope(d, angle);
    if (!(slope > 0) || !(angle > 0) || !(angle < 0.5 * kPi)) return std::nullopt;
    const double missing = wanted - FisheyeRadius(d, angle);
    angle += missing / slope;
    if (std::abs(missing) < kCloseEnough) return std::tan(angle) / wanted * distorted;
  }
  return std::nullopt;
}

glm::dmat2 JacobianOf(const Distortion& d, const glm::dvec2& ray) {
  if (HasFiveCoefficients(d)) return BrownJacobian(d, ray);
  constexpr double kStep = 1e-6;
  const glm::dvec2 x(kStep, 0), y(0, kStep);
  return {(Distort(d, ray + x) - Distort(d, ray - x)) / (2 * kStep),
          (Distort(d, ray + y) - Distort(d, ray - y)) / (2 * kStep)};
}

/// Returns the ray (x, y, 1), in the camera's frame, of a pinhole's pixel; PixelOf is its inverse.
glm::dvec2 RayOf(const Intrinsics& in, const glm::dvec2& pixel) {
  const double y = (pixel.y - in.cy) / in.fy;
  return {(pixel.x - in.cx - in.skew * y) / in.fx, y};
}

glm::dvec2 PixelOf(const Intrinsics& in, const glm::dvec2& ray) {
  return {in.fx * ray.x + in.skew * ray.y + in.cx, in.fy * ray.y + in.cy};
}

}  // namespace

glm::dvec2 Distort(const Distortion& d, const glm::dvec2& ray) {
  if (HasFiveCoefficients(d)) return Brown(d, ray);
  if (!d.is_fisheye) return FullBrown(d, ray);
  const double radius = glm::length(ray);
  return radius > 0 ? FisheyeRadius(d, std::atan(radius)) / radius * ray : ray;
}

std::optional<glm::dvec2> Undistort(const Distortion& distortion, const glm::dvec2& distorted) {
  if (distortion.IsNone()) return distorted;
  if (distortion.is_fisheye) return UndistortFisheye(distortion, distorted);
  glm::dvec2 ray = distorted;
  for (int step = 0; step < kMaxSteps; ++step) {
    const glm::dmat2 jacobian = JacobianOf(distortion, ray);
    // If the determinant is not positive, the model folds back at this ray (camera.h), and there is no solution.
    if (!(glm::determinant(jacobian) > 0) || !(jacobian[0][0] > 0)) return std::nullopt;
    const glm::dvec2 missing = distorted - Distort(distortion, ray);
    ray += glm::inverse(jacobian) * missing;
    if (glm::length(missing) < kCloseEnough) return ray;
  }
  return std::nullopt;
}

Camera LookAt(const Intrinsics& intrinsics, const glm::dvec3& p_WC, const glm::dvec3& p_WT) {
  const glm::dvec3 z_W = glm::normalize(p_WT - p_WC);
  const glm::dvec3 right_W = glm::cross(z_W, glm::dvec3(0, 1, 0));
  [[maybe_unused]] constexpr double kVertical = 1e-9;
  assert(glm::length(right_W) > kVertical && "a vertical view has no upright picture");
  const glm::dvec3 x_W = glm::normalize(right_W);
  const glm::dvec3 y_W = glm::cross(z_W, x_W);
  // The rows of R_CW are the camera's axes in the world.
  return {intrinsics, glm::transpose(glm::dmat3(x_W, y_W, z_W)), p_WC, {}};
}

ProjectionMatrix MatrixOf(const Camera& camera) {
  const Intrinsics& in = camera.intrinsics;
  const glm::dmat3 K = glm::transpose(glm::dmat3(in.fx, in.skew, in.cx, 0, in.fy, in.cy, 0, 0, 1));
  const glm::dmat3 M = K * camera.R_CW;
  const glm::dvec3 last = -(M * camera.p_WC);  // the fourth column of H: K p_CW
  ProjectionMatrix matrix;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) matrix.h[row][column] = M[column][row];
    matrix.h[row][3] = last[row];
  }
  return matrix;
}

std::optional<glm::dvec2> Project(const ProjectionMatrix& matrix, const glm::dvec3& p_WQ) {
  glm::dvec3 p;  // (u·w, v·w, w)
  for (int row = 0; row < 3; ++row) {
    const auto& h = matrix.h[row];
    p[row] = h[0] * p_WQ.x + h[1] * p_WQ.y + h[2] * p_WQ.z + h[3];
  }
  constexpr double kOnThePlane = 1e-9;
  if (!(p.z > kOnThePlane)) return std::nullopt;
  return glm::dvec2(p.x / p.z, p.y / p.z);
}

std::optional<glm::dvec2> Project(const Camera& camera, const glm::dvec3& p_WQ) {
  const auto pixel = Project(MatrixOf(camera), p_WQ);
  if (!pixel || camera.distortion.IsNone()) return pixel;
  return DistortPixel(camera, *pixel);
}

std::optional<glm::dvec2> DistortPixel(const Camera& camera, const glm::dvec2& pixel) {
  if (camera.distortion.IsNone()) return pixel;
  const glm::dvec2 ray = RayOf(camera.intrinsics, pixel);
  const glm::dvec2 distorted = Distort(camera.distortion, ray);
  // For a ray at which the model has folded back, `Undistort` returns another ray.
  constexpr double kSameRay = 1e-6;
  const auto back = Undistort(camera.distortion, distorted);
  if (!back || glm::length(*back - ray) > kSameRay) return std::nullopt;
  return PixelOf(camera.intrinsics, distorted);
}

std::optional<glm::dvec2> UndistortPixel(const Camera& camera, const glm::dvec2& pixel) {
  if (camera.distortion.IsNone()) return pixel;
  const auto ray = Undistort(camera.distortion, RayOf(camera.intrinsics, pixel));
  if (!ray) return std::nullopt;
  return PixelOf(camera.intrinsics, *ray);
}

}  // namespace etude
