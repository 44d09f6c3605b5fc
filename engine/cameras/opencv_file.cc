#include "engine/cameras/opencv_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <vector>

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
    if (count != 0 && count != 4) return Fail({}, "{} distortion coefficients of a fisheye; allowed: 0 or 4", count);
    c.resize(4);
    return Distortion{.k1 = c[0], .k2 = c[1], .k3 = c[2], .k4 = c[3], .is_fisheye = true};
  }
  if (count != 0 && count != 4 && count != 5 && count != 8 && count != 12 && count != 14) {
    return Fail({}, "{} distortion coefficients; allowed: 0, 4 (k1, k2, p1, p2), 5 (and k3), 8, 12 or 14", count);
  }
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
    return Fail({}, "a picture of {:g} x {:g} pixels; allowed: whole numbers of 1 to 65536", p.width, p.height);
  }
  const std::vector<double>& K = p.camera_matrix;
  if (K.size() != 9) return Fail({}, "the camera matrix has {} numbers; allowed: 9", K.size());
  if (!AreFinite(p)) return Fail({}, "a number that is not finite");
  if (!(K[0] > 0) || !(K[4] > 0))
    return Fail({}, "focal lengths of {:g} and {:g}; allowed: numbers above 0", K[0], K[4]);
  if (K[3] != 0 || K[6] != 0 || K[7] != 0 || K[8] != 1) {
    return Fail({}, "the camera matrix must end in rows 0 fy cy, 0 0 1");
  }
  if (!IsRotation(p.R)) return Fail({}, "R is no rotation");
  Camera camera;
  camera.intrinsics = {.width = static_cast<int>(p.width),
                       .height = static_cast<int>(p.height),
                       .fx = K[0],
                       .fy = K[4],
                       .cx = K[2] + kOurPixelCentre,
                       .cy = K[5] + kOurPixelCentre,
                       .skew = K[1]};
  ASSIGN_OR_RETURN(camera.distortion, DistortionOf(p));
  camera.R_CW = p.R;
  camera.p_WC = -(glm::transpose(p.R) * p.T);
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
  if (n.size() == 3) return MatrixOfRodrigues({n[0], n[1], n[2]});
  if (n.size() != 9)
    return Fail({}, "{} has {} numbers; allowed: 3 (Rodrigues' vector) or 9 (a matrix)", what, n.size());
  return glm::transpose(glm::dmat3(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8]));
}

std::optional<std::vector<double>> NumbersOf(std::string_view text) {
  constexpr std::string_view kBetween = " \t\r\n,[]";
  std::vector<double> numbers;
  while (true) {
    const std::size_t start = text.find_first_not_of(kBetween);
    if (start == std::string_view::npos) return numbers;
    text.remove_prefix(start);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{}) return std::nullopt;
    numbers.push_back(value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (!text.empty() && kBetween.find(text.front()) == std::string_view::npos) return std::nullopt;
  }
}

std::string RealText(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

namespace {

/// Formats a number for FileStorage, which recognises a real number by its decimal point.
std::string Real(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".";
  return text;
}

/// Formats a matrix; `values` are row by row.
std::string Matrix(std::string_view name, int rows, int columns, const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(Real(value));
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n", name, rows, columns,
                     fmt::join(texts, ", "));
}

/// Returns the text after "name:" at the beginning of a line, up to the end of `text`.
std::optional<std::string_view> Behind(std::string_view text, std::string_view name) {
  const std::string wanted = "\n" + std::string(name) + ":";
  const std::size_t at = text.find(wanted);
  if (at == std::string_view::npos) return std::nullopt;
  return text.substr(at + wanted.size());
}

/// Returns the numbers of a matrix; empty if there is none of that name or it cannot be read.
std::vector<double> MatrixNamed(std::string_view text, std::string_view name) {
  const auto behind = Behind(text, name);
  if (!behind) return {};
  const std::size_t from = behind->find("data:"), to = behind->find(']', from);
  if (from == std::string_view::npos || to == std::string_view::npos) return {};
  return NumbersOf(behind->substr(from + 5, to - from - 5)).value_or(std::vector<double>{});
}

/// Returns true if a matrix exists and holds no number.
bool IsEmptyMatrix(std::string_view text, std::string_view name) {
  const auto behind = Behind(text, name);
  const std::size_t from = behind ? behind->find("data:") : std::string_view::npos;
  if (from == std::string_view::npos) return false;
  const std::size_t open = behind->find('[', from), close = behind->find(']', from);
  return open < close && close != std::string_view::npos &&
         behind->substr(open + 1, close - open - 1).find_first_not_of(" \t\r\n") == std::string_view::npos;
}

double NumberNamed(std::string_view text, std::string_view name) {
  const auto behind = Behind(text, name);
  if (!behind) return 0;
  const auto numbers = NumbersOf(behind->substr(0, behind->find('\n')));
  return numbers && numbers->size() == 1 ? numbers->front() : 0;
}

}  // namespace

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

Result<Camera> ReadOpenCvCamera(std::string_view text) {
  OpenCvParameters p{.width = NumberNamed(text, "image_width"),
                     .height = NumberNamed(text, "image_height"),
                     .camera_matrix = MatrixNamed(text, "camera_matrix"),
                     .distortion = MatrixNamed(text, "distortion_coefficients"),
                     .is_fisheye = NumberNamed(text, "fisheye") != 0};
  // If a lens is given but cannot be read, fail, because it must not be ignored.
  const bool has_lens = Behind(text, "distortion_coefficients").has_value();
  if (has_lens && p.distortion.empty() && !IsEmptyMatrix(text, "distortion_coefficients")) {
    return Fail({}, "distortion_coefficients cannot be read; allowed: a matrix of OpenCV");
  }
  if (const auto flag = Behind(text, "fisheye")) {
    const auto numbers = NumbersOf(flag->substr(0, flag->find('\n')));
    if (!numbers || numbers->size() != 1) return Fail({}, "fisheye cannot be read; allowed: 0 or 1");
  }
  for (const char* name : {"R", "T"}) {
    if (!Behind(text, name)) continue;
    const std::vector<double> values = MatrixNamed(text, name);
    const std::size_t wanted = *name == 'R' ? 9 : 3;
    if (values.size() != wanted) return Fail({}, "{} has {} numbers; allowed: {}", name, values.size(), wanted);
    for (int i = 0; i < static_cast<int>(wanted); ++i) {
      (*name == 'R' ? p.R[i % 3][i / 3] : p.T[i]) = values[static_cast<std::size_t>(i)];
    }
  }
  return CameraOf(p);
}

}  // namespace etude
