#include "engine/cameras/opencv_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "engine/cameras/calibration_text.h"

namespace etude {
namespace {

/// FileStorage tells a real number from a whole one by its point.
std::string Real(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".";
  return text;
}

/// `values` row by row.
std::string Matrix(std::string_view name, int rows, int columns, const std::vector<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(Real(value));
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n", name, rows, columns,
                     fmt::join(texts, ", "));
}

/// What stands behind "name:" at the beginning of a line, to the end of the text.
std::optional<std::string_view> Behind(std::string_view text, std::string_view name) {
  const std::string wanted = "\n" + std::string(name) + ":";
  const std::size_t at = text.find(wanted);
  if (at == std::string_view::npos) return std::nullopt;
  return text.substr(at + wanted.size());
}

/// The numbers of a matrix; empty when there is none of that name, or it cannot be read.
std::vector<double> MatrixNamed(std::string_view text, std::string_view name) {
  const auto behind = Behind(text, name);
  if (!behind) return {};
  const std::size_t from = behind->find("data:"), to = behind->find(']', from);
  if (from == std::string_view::npos || to == std::string_view::npos) return {};
  return NumbersOf(behind->substr(from + 5, to - from - 5)).value_or(std::vector<double>{});
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
         Matrix("camera_matrix", 3, 3, p.camera_matrix) + Matrix("distortion_coefficients", 5, 1, p.distortion) +
         Matrix("R", 3, 3, {R[0][0], R[1][0], R[2][0], R[0][1], R[1][1], R[2][1], R[0][2], R[1][2], R[2][2]}) +
         Matrix("T", 3, 1, {p.T.x, p.T.y, p.T.z});
}

Result<Camera> ReadOpenCvCamera(std::string_view text) {
  OpenCvParameters p{.width = NumberNamed(text, "image_width"),
                     .height = NumberNamed(text, "image_height"),
                     .camera_matrix = MatrixNamed(text, "camera_matrix"),
                     .distortion = MatrixNamed(text, "distortion_coefficients")};
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
