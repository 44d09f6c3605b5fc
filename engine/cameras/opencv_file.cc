#include "engine/cameras/opencv_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr double kOurPixelCentre = 0.5;

bool IsSide(double pixels) { return pixels >= 1 && pixels <= 65536 && pixels == std::floor(pixels); }

bool AreFinite(const OpenCvParameters& p) {
  double sum = 0;  // the sum is finite only if all numbers are
  for (const double value : p.camera_matrix) sum += std::abs(value);
  for (const double value : p.distortion) sum += std::abs(value);
  for (int i = 0; i < 3; ++i) sum += glm::length(p.R[i]) + std::abs(p.T[i]);
  return std::isfinite(sum);
}

bool IsRotation(const glm::dmat3& R) {
  constexpr double kTolerance = 1e-6;
  const glm::dmat3 product = R * glm::transpose(R);
  double off = std::abs(glm::determinant(R) - 1);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) off = std::max(off, std::abs(product[i][j] - (i == j ? 1 : 0)));
  }
  return off < kTolerance;
}

/// Returns the rotation nearest to `R`, by Newton's iteration, if `R` differs from a rotation only by the rounding of
/// its numbers. Otherwise returns `R` unchanged.
glm::dmat3 Orthonormal(const glm::dmat3& R) {
  const glm::dmat3 off = R * glm::transpose(R) - glm::dmat3(1);
  constexpr double kRounded = 3e-3;  // EasyMocap wrote three decimals
  for (int i = 0; i < 3; ++i) {
    if (!(glm::length(off[i]) < kRounded)) return R;
  }
  glm::dmat3 near = R;
  for (int step = 0; step < 3; ++step) near = 0.5 * (near + glm::transpose(glm::inverse(near)));
  return near;
}

std::vector<double> CoefficientsOf(const Distortion& d) {
  if (d.is_fisheye) return {d.k1, d.k2, d.k3, d.k4};
  const std::array all = {d.k1, d.k2, d.p1, d.p2, d.k3, d.k4, d.k5, d.k6, d.s1, d.s2, d.s3, d.s4, d.tau_x, d.tau_y};
  std::size_t count = all.size();
  // Drop trailing coefficients that are zero, down to 5.
  for (const std::size_t fewer : {12, 8, 5}) {
    if (std::all_of(all.begin() + static_cast<std::ptrdiff_t>(fewer), all.end(), [](double c) { return c == 0; })) {
      count = fewer;
    }
  }
  return {all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)};
}

Result<Distortion> DistortionOf(const OpenCvParameters& p) {
  std::vector<double> c = p.distortion;
  const std::size_t count = c.size();
  if (p.is_fisheye) {
    if (count != 0 && count != 4)
      return Fail({}, "found {} distortion coefficients for a fisheye lens; allowed: 0 or 4", count);
    c.resize(4);
    return Distortion{.k1 = c[0], .k2 = c[1], .k3 = c[2], .k4 = c[3], .is_fisheye = true};
  }
  if (count != 0 && count != 4 && count != 5 && count != 8 && count != 12 && count != 14) {
    return Fail({},
                "found {} distortion coefficients; allowed: 0, 4 (k1, k2, p1, p2), 5 (k1, k2, p1, p2, k3), 8, 12 or 14",
                count);
  }
  // Coefficients that are not given are 0.
  c.resize(14);
  return Distortion{.k1 = c[0],
                    .k2 = c[1],
                    .p1 = c[2],
                    .p2 = c[3],
                    .k3 = c[4],
                    .k4 = c[5],
                    .k5 = c[6],
                    .k6 = c[7],
                    .s1 = c[8],
                    .s2 = c[9],
                    .s3 = c[10],
                    .s4 = c[11],
                    .tau_x = c[12],
                    .tau_y = c[13]};
}

std::string Matrix(std::string_view name, int rows, int columns, const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(RealText(value, "."));
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n", name, rows, columns,
                     fmt::join(texts, ", "));
}

}  // namespace

OpenCvParameters ParametersOf(const Camera& camera) {
  const Intrinsics& in = camera.intrinsics;
  const Distortion& d = camera.distortion;
  return {.width = static_cast<double>(in.width),
          .height = static_cast<double>(in.height),
          .camera_matrix = {in.fx, in.skew, in.cx - kOurPixelCentre, 0, in.fy, in.cy - kOurPixelCentre, 0, 0, 1},
          .distortion = CoefficientsOf(d),
          .R = camera.R_CW,
          .T = -(camera.R_CW * camera.p_WC),
          .is_fisheye = d.is_fisheye};
}

Result<Camera> CameraOf(const OpenCvParameters& p) {
  if (!IsSide(p.width) || !IsSide(p.height)) {
    return Fail({}, "the picture has {:g} x {:g} pixels; allowed: whole numbers from 1 to 65536", p.width, p.height);
  }
  const std::vector<double>& K = p.camera_matrix;
  if (K.size() != 9) return Fail({}, "the camera matrix has {} numbers; allowed: 9", K.size());
  if (!AreFinite(p)) return Fail({}, "a parameter of the camera is not finite");
  if (!(K[0] > 0) || !(K[4] > 0))
    return Fail({}, "the focal lengths are {:g} and {:g}; allowed: numbers above 0", K[0], K[4]);
  if (K[3] != 0 || K[6] != 0 || K[7] != 0 || K[8] != 1) {
    return Fail({}, "the last two rows of the camera matrix must be (0, fy, cy) and (0, 0, 1)");
  }
  const glm::dmat3 R = IsRotation(p.R) ? p.R : Orthonormal(p.R);
  if (!IsRotation(R)) {
    return Fail({}, "R is not a rotation matrix{}",
                IsRotation(-R) ? "; it is a reflection, with the determinant -1; allowed: the determinant 1" : "");
  }
  Camera camera;
  camera.intrinsics = {.width = static_cast<int>(p.width),
                       .height = static_cast<int>(p.height),
                       .fx = K[0],
                       .fy = K[4],
                       .cx = K[2] + kOurPixelCentre,
                       .cy = K[5] + kOurPixelCentre,
                       .skew = K[1]};
  ASSIGN_OR_RETURN(camera.distortion, DistortionOf(p));
  camera.R_CW = R;
  camera.p_WC = -(glm::transpose(R) * p.T);
  return camera;
}

glm::dmat3 MatrixOfRodrigues(const glm::dvec3& vector) {
  const double angle = glm::length(vector);
  return angle > 0 ? glm::mat3_cast(glm::angleAxis(angle, vector / angle)) : glm::dmat3(1);
}

Result<glm::dmat3> RotationOf(std::span<const double> n, std::string_view what) {
  if (!std::ranges::all_of(n, [](double value) { return std::isfinite(value); })) {
    return Fail({}, "{} has a number that is not finite", what);
  }
  if (n.size() == 3) {
    // Programs write angles up to half a turn. A solver's result may exceed half a turn, but hardly a whole turn.
    const glm::dvec3 vector(n[0], n[1], n[2]);
    if (glm::length(vector) <= 2 * kPi) return MatrixOfRodrigues(vector);
    return Fail({}, "{} is a turn by {:.4g}; allowed: at most a whole turn, 6.283, in radians", what,
                glm::length(vector));
  }
  if (n.size() != 9)
    return Fail({}, "{} has {} numbers; allowed: 3 (Rodrigues' vector) or 9 (a matrix)", what, n.size());
  return glm::transpose(glm::dmat3(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]));
}

std::string RealText(double value, std::string_view point) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += point;
  return text;
}

std::string WriteOpenCvCamera(const Camera& camera) {
  const OpenCvParameters p = ParametersOf(camera);
  const glm::dmat3& R = p.R;
  return fmt::format("%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\n", p.width, p.height) +
         Matrix("camera_matrix", 3, 3, p.camera_matrix) +
         Matrix("distortion_coefficients", static_cast<int>(p.distortion.size()), 1, p.distortion) +
         (p.is_fisheye ? "fisheye: 1\n" : "") +
         Matrix("R", 3, 3, {R[0][0], R[1][0], R[2][0], R[0][1], R[1][1], R[2][1], R[0][2], R[1][2], R[2][2]}) +
         Matrix("T", 3, 1, {p.T.x, p.T.y, p.T.z});
}

}  // namespace etude
