#include "engine/cameras/point_error.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>

namespace etude {
namespace {

/// The effect of one camera's errors on a pixel whose lens distortion is removed.
struct PixelErrors {
  std::size_t camera = 0;
  glm::dmat3x2 by_position{0};  ///< derivative of the pixel with respect to the position, px/m
  glm::dmat2 noise{0};          ///< covariance of the pixel, px²
  /// Shift of the pixel, px, that one standard deviation of each calibration parameter causes.
  std::array<glm::dvec2, kCalibrationParameters> by_calibration{};
};

/// Returns the pixel that shows Q, with lens distortion; nullopt if the pixel is outside the picture.
std::optional<glm::dvec2> PixelInPicture(const Camera& camera, const glm::dvec3& p_WQ) {
  const auto pixel = Project(camera, p_WQ);
  const Intrinsics& in = camera.intrinsics;
  if (!pixel || !(pixel->x >= 0 && pixel->y >= 0 && pixel->x <= in.width && pixel->y <= in.height)) return std::nullopt;
  return pixel;
}

/// Returns the covariance of a pixel whose lens distortion is removed, px²; nullopt if the distortion of a neighbouring
/// pixel cannot be removed.
std::optional<glm::dmat2> NoiseWithoutLens(const Camera& camera, const glm::dvec2& shown, double noise_px) {
  if (camera.distortion.IsNone()) return glm::dmat2(noise_px * noise_px);
  constexpr double kStep = 0.1;  // pixels
  glm::dmat2 by_shown;
  for (int axis = 0; axis < 2; ++axis) {
    glm::dvec2 step(0);
    step[axis] = kStep;
    const auto above = UndistortPixel(camera, shown + step), below = UndistortPixel(camera, shown - step);
    if (!above || !below) return std::nullopt;
    by_shown[axis] = (*above - *below) / (2 * kStep);
  }
  return noise_px * noise_px * by_shown * glm::transpose(by_shown);
}

std::optional<PixelErrors> PixelErrorsOf(const Camera& camera, std::size_t index, const glm::dvec3& p_WQ,
                                         const SightingErrors& errors) {
  const auto shown = PixelInPicture(camera, p_WQ);
  if (!shown) return std::nullopt;
  PixelErrors pixel{.camera = index};
  const auto noise = NoiseWithoutLens(camera, *shown, errors.noise_px);
  if (!noise) return std::nullopt;
  pixel.noise = *noise;
  // Compute the derivative of the pixel with respect to the point in the camera's frame.
  const Intrinsics& in = camera.intrinsics;
  const glm::dvec3 p_CQ = camera.R_CW * (p_WQ - camera.p_WC);
  const double x = p_CQ.x / p_CQ.z, y = p_CQ.y / p_CQ.z;
  const glm::dmat3x2 by_point(glm::dvec2(in.fx, 0) / p_CQ.z, glm::dvec2(in.skew, in.fy) / p_CQ.z,
                              glm::dvec2(-in.fx * x - in.skew * y, -in.fy * y) / p_CQ.z);
  pixel.by_position = by_point * camera.R_CW;
  // Compute the shift of the pixel that one standard deviation of each calibration parameter causes.
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 unit(0);
    unit[axis] = 1;
    pixel.by_calibration[axis] = errors.calibration.turn * (by_point * glm::cross(unit, p_CQ));
    pixel.by_calibration[3 + axis] = errors.calibration.place_m * (pixel.by_position * unit);
  }
  pixel.by_calibration[6] = errors.calibration.focal * glm::dvec2(in.fx * x, in.fy * y);
  return pixel;
}

/// Returns (JᵀJ)⁻¹ over the cameras in `subset`; nullopt if their lines of sight are (nearly) parallel.
std::optional<glm::dmat3> InverseNormal(std::span<const PixelErrors> pixels, std::uint64_t subset) {
  glm::dmat3 normal(0);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (subset >> i & 1) normal += glm::transpose(pixels[i].by_position) * pixels[i].by_position;
  }
  const double trace = normal[0][0] + normal[1][1] + normal[2][2];
  // The value of det / (trace / 3)³ for two lines of sight of equal weight at an angle of 3·10⁻⁵ rad.
  constexpr double kParallel = 1e-9;
  if (!(glm::determinant(normal) > kParallel * std::pow(trace / 3, 3))) return std::nullopt;
  return glm::inverse(normal);
}

}  // namespace

double PointError::Rms() const { return std::sqrt(covariance[0][0] + covariance[1][1] + covariance[2][2]); }

bool HasInPicture(const Camera& camera, const glm::dvec3& p_WQ) { return PixelInPicture(camera, p_WQ).has_value(); }

PointError ExpectedPointError(std::span<const Camera> cameras, const glm::dvec3& p_WQ, const SightingErrors& errors) {
  assert(errors.dropout == 0 || cameras.size() <= kMaxDroppingCameras);
  assert(cameras.size() < 64);
  std::vector<PixelErrors> pixels;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (auto pixel = PixelErrorsOf(cameras[i], i, p_WQ, errors)) pixels.push_back(*pixel);
  }
  PointError expected{.cameras = static_cast<int>(pixels.size())};
  expected.displacements.resize(cameras.size());
  // Add up the covariances of all combinations of cameras, each times its probability.
  const std::uint64_t all = (std::uint64_t{1} << pixels.size()) - 1;
  double measured = 0;
  for (std::uint64_t subset = all; subset > 0; --subset) {
    const int count = std::popcount(subset);
    if (subset != all && errors.dropout == 0) break;
    if (count < 2) continue;
    const double share = std::pow(1 - errors.dropout, count) * std::pow(errors.dropout, expected.cameras - count);
    const auto inverse = InverseNormal(pixels, subset);
    if (!inverse) continue;
    measured += share;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (!(subset >> i & 1)) continue;
      const PixelErrors& pixel = pixels[i];
      const glm::dmat2x3 gain = *inverse * glm::transpose(pixel.by_position);  // the matrix K of ExpectedPointError
      const glm::dmat3 noise = share * (gain * pixel.noise * glm::transpose(gain));
      expected.noise += noise;
      expected.covariance += noise;
      for (std::size_t k = 0; k < kCalibrationParameters; ++k) {
        const glm::dvec3 moved = gain * pixel.by_calibration[k];
        expected.displacements[pixel.camera][k] += share * moved;
        expected.covariance += share * glm::outerProduct(moved, moved);
      }
    }
  }
  // Divide by the probability that the point is measured.
  expected.lost = std::max(0.0, 1 - measured);
  if (measured <= 0) return expected;
  expected.covariance /= measured;
  expected.noise /= measured;
  for (auto& of_camera : expected.displacements) {
    for (glm::dvec3& displacement : of_camera) displacement /= measured;
  }
  return expected;
}

}  // namespace etude
