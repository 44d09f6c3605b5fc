#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"

namespace etude {

// What files of cameras have in common. OpenCV's pixels have their centres at whole numbers, ours at halves.

/// A camera as OpenCV tells it: K row by row, distortion (k1, k2, p1, p2 and perhaps k3), and where the world is in the
/// camera's frame: X_C = R X_W + T.
struct OpenCvParameters {
  double width = 0, height = 0;
  std::vector<double> camera_matrix;
  std::vector<double> distortion;
  glm::dmat3 R{1};
  glm::dvec3 T{0};
};

OpenCvParameters ParametersOf(const Camera& camera);
/// Fails when they are no camera's, saying why.
Result<Camera> CameraOf(const OpenCvParameters& parameters);

/// All numbers of a text such as "[ [1., 0], [2e-3]]"; nothing when something else stands among them.
std::optional<std::vector<double>> NumbersOf(std::string_view text);

/// A real number that no reader takes for a whole one: "600.0".
std::string RealText(double value);

}  // namespace etude
