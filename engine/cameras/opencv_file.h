#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"

namespace etude {

/// Writes a camera as OpenCV's cv::FileStorage does (YAML 1.0): `image_width`, `image_height`, `camera_matrix` (3 × 3),
/// `distortion_coefficients` (k1, k2, p1, p2, k3), and the extrinsics `R` (3 × 3) and `T` (3 × 1, metres):
/// a point X of the world is at R X + T in the camera's frame, x right, y down, z forward. In OpenCV the centre of the
/// top left pixel is (0, 0), here it is (0.5, 0.5): the principal point is told in OpenCV's coordinates.
std::string WriteOpenCvCamera(const Camera& camera);

/// Reads what WriteOpenCvCamera or cv::FileStorage has written: those names, matrices of any numbers; without `R` and
/// `T` the camera is the world's frame, with four distortion coefficients k3 is 0. Fails, naming what is missing or
/// wrong: a size that is no picture's, a focal length that is not positive, an R that is no rotation (1e-6).
Result<Camera> ReadOpenCvCamera(std::string_view text);

}  // namespace etude
