#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "engine/cameras/camera.h"

namespace etude {

/// A camera's matrix as formulas need it that ask how large things look. Frames: W the world, Q any point.
class PixelScale {
 public:
  explicit PixelScale(const ProjectionMatrix& matrix) {
    const auto row = [&](int i) { return glm::dvec3(matrix.h[i][0], matrix.h[i][1], matrix.h[i][2]); };
    const double length = glm::length(row(2));
    for (int i = 0; i < 3; ++i) {
      rows_[i] = row(i) / length;
      offsets_[i] = matrix.h[i][3] / length;
    }
    focal_px_ = std::sqrt(glm::length(glm::cross(rows_[0], rows_[2])) * glm::length(glm::cross(rows_[1], rows_[2])));
  }

  /// Along the camera's axis, metres; positive in front of it.
  double DepthOf(const glm::dvec3& p_WQ) const { return glm::dot(rows_[2], p_WQ) + offsets_[2]; }
  glm::dvec2 PixelOf(const glm::dvec3& p_WQ) const {
    return glm::dvec2(glm::dot(rows_[0], p_WQ) + offsets_[0], glm::dot(rows_[1], p_WQ) + offsets_[1]) / DepthOf(p_WQ);
  }
  /// What a length of one metre, one metre away, is in pixels: the geometric mean of both directions.
  double focal_px() const { return focal_px_; }

  /// The gradients of u, v and of the pixels per metre, with respect to the place of the point.
  struct Slopes {
    glm::dvec3 u, v, pixels_per_metre;
  };
  Slopes SlopesAt(const glm::dvec3& p_WQ) const {
    const double depth = DepthOf(p_WQ);
    const glm::dvec2 pixel = PixelOf(p_WQ);
    return {(rows_[0] - pixel.x * rows_[2]) / depth, (rows_[1] - pixel.y * rows_[2]) / depth,
            -focal_px_ / (depth * depth) * rows_[2]};
  }

 private:
  std::array<glm::dvec3, 3> rows_{};
  std::array<double, 3> offsets_{};
  double focal_px_ = 0;
};

}  // namespace etude
