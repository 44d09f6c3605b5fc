#pragma once

#include <string>

#include "engine/cameras/camera.h"

namespace etude {

/// Writes a camera as OpenCV's cv::FileStorage does (YAML 1.0): `image_width`, `image_height`, `camera_matrix` (3 × 3),
/// `distortion_coefficients` (five zeros: a pinhole has none), and the extrinsics `R` (3 × 3) and `T` (3 × 1, metres):
/// a point X of the world is at R X + T in the camera's frame, x right, y down, z forward. In OpenCV the centre of the
/// top left pixel is (0, 0), here it is (0.5, 0.5): the principal point is told in OpenCV's coordinates.
std::string WriteOpenCvCamera(const Camera& camera);

}  // namespace etude
