#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"

namespace etude {

// Helpers that all formats of camera files share. OpenCV's pixel centres are at integers, ours at half-integers.

/// A camera in OpenCV's parameters. `camera_matrix` is K row by row. `distortion` holds the first 0, 4, 5, 8, 12 or 14
/// of k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tau_x, tau_y; for a fisheye, k1 to k4 or nothing. R and T
/// transform from the world to the camera's frame: X_C = R X_W + T.
struct OpenCvParameters {
  double width = 0, height = 0;
  std::vector<double> camera_matrix = {};
  std::vector<double> distortion = {};
  glm::dmat3 R{1};
  glm::dvec3 T{0};
  bool is_fisheye = false;
};

/// Rotates from a world with Z up to ours: (x, y, z) becomes (y, z, x).
inline const glm::dmat3 kYUpOfZUp(0, 0, 1, 1, 0, 0, 0, 1, 0);

/// Returns the camera's parameters, with 5, 8, 12 or 14 distortion coefficients: the smallest of these counts that
/// keeps all coefficients other than 0. A fisheye camera always has 4.
OpenCvParameters ParametersOf(const Camera& camera);
/// Makes a camera from the parameters. Fails, with the reason, if the parameters do not describe a camera.
Result<Camera> CameraOf(const OpenCvParameters& parameters);

/// Converts Rodrigues' vector (the axis times the angle) to a rotation matrix.
glm::dmat3 MatrixOfRodrigues(const glm::dvec3& vector);
/// Reads a rotation from 3 numbers (Rodrigues' vector) or 9 (row by row). Fails, naming `what`, for other counts.
Result<glm::dmat3> RotationOf(std::span<const double> numbers, std::string_view what);

/// Formats a number so that readers parse it as a real number, not as an integer: `point` is appended to a text such as
/// "600".
std::string RealText(double value, std::string_view point);

/// Writes a camera in the format of OpenCV's cv::FileStorage (YAML 1.0): `image_width`, `image_height`, `camera_matrix`
/// (3 × 3), `distortion_coefficients` (k1, k2, p1, p2, k3, and the further ones if any is not 0; for a fisheye four,
/// and `fisheye: 1`), and the extrinsics `R` (3 × 3) and `T` (3 × 1, metres): a point X of the world is at R X + T in
/// the camera's frame, x right, y down, z forward. In OpenCV the centre of the top left pixel is (0, 0), here it is
/// (0.5, 0.5); the principal point is written in OpenCV's coordinates. ReadRigFile reads such a file.
std::string WriteOpenCvCamera(const Camera& camera);

}  // namespace etude
