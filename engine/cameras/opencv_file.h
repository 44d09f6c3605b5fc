#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"

namespace etude {

// What files of cameras have in common. OpenCV's pixels have their centres at whole numbers, ours at halves.

/// A camera in OpenCV's parameters: K row by row, distortion (k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tau_x,
/// tau_y: the first 0, 4, 5, 8, 12 or 14; of a fisheye 0 or 4: k1 to k4), and where the world is in the camera's frame:
/// X_C = R X_W + T.
struct OpenCvParameters {
  double width = 0, height = 0;
  std::vector<double> camera_matrix = {};
  std::vector<double> distortion = {};
  glm::dmat3 R{1};
  glm::dvec3 T{0};
  bool is_fisheye = false;
};

OpenCvParameters ParametersOf(const Camera& camera);
/// Makes a camera of the parameters. Fails, with
/// the reason, when they are no camera's.
Result<Camera> CameraOf(const OpenCvParameters& parameters);

/// Turns Rodrigues' vector, an axis as long as its angle, into the rotation.
glm::dmat3 MatrixOfRodrigues(const glm::dvec3& vector);
/// Reads a rotation of 3 numbers (Rodrigues' vector) or 9 (row by row). Fails, naming `what`, for other counts.
Result<glm::dmat3> RotationOf(std::span<const double> numbers, std::string_view what);

/// Reads all numbers of a text such as "[ [1., 0], [2e-3]]"; nothing when something else stands among them.
std::optional<std::vector<double>> NumbersOf(std::string_view text);

/// Formats a number so that no reader takes it for a whole one: "600.0".
std::string RealText(double value);

/// Writes a camera as OpenCV's cv::FileStorage does (YAML 1.0): `image_width`, `image_height`, `camera_matrix` (3 × 3),
/// `distortion_coefficients` (k1, k2, p1, p2, k3, more where there are more; of a fisheye four, and `fisheye: 1`), and
/// the extrinsics `R` (3 × 3) and `T` (3 × 1, metres): a point X of the world is at R X + T in the camera's frame, x
/// right, y down, z forward. In OpenCV the centre of the top left pixel is (0, 0), here it is (0.5, 0.5): the principal
/// point is told in OpenCV's coordinates.
std::string WriteOpenCvCamera(const Camera& camera);

/// Reads what WriteOpenCvCamera or cv::FileStorage has written: those names, matrices of any numbers; without `R` and
/// `T` the camera is the world's frame. Fails, naming what is missing or
/// wrong: a size that is no picture's, a focal length that is not positive, an R that is no rotation (1e-6).
Result<Camera> ReadOpenCvCamera(std::string_view text);

}  // namespace etude
