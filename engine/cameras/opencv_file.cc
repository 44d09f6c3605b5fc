#include "engine/cameras/opencv_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

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

}  // namespace

std::string WriteOpenCvCamera(const Camera& camera) {
  constexpr double kOurPixelCentre = 0.5;
  const Intrinsics& in = camera.intrinsics;
  const glm::dmat3& R = camera.R_CW;
  const glm::dvec3 p_CW = -(R * camera.p_WC);
  return fmt::format("%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\n", in.width, in.height) +
         Matrix("camera_matrix", 3, 3,
                {in.fx, in.skew, in.cx - kOurPixelCentre, 0, in.fy, in.cy - kOurPixelCentre, 0, 0, 1}) +
         Matrix("distortion_coefficients", 5, 1, {0, 0, 0, 0, 0}) +
         Matrix("R", 3, 3, {R[0][0], R[1][0], R[2][0], R[0][1], R[1][1], R[2][1], R[0][2], R[1][2], R[2][2]}) +
         Matrix("T", 3, 1, {p_CW.x, p_CW.y, p_CW.z});
}

}  // namespace etude
