#include "sim/depth_camera/normals.h"

#include <cmath>
#include <optional>

namespace etude {
namespace {

/// The surface points that pixels show, in the camera's frame.
class Points {
 public:
  Points(const DepthImage& depth, const Camera& camera) : points_(depth.width, depth.height) {
    const Intrinsics& in = camera.intrinsics;
    for (int y = 0; y < depth.height; ++y) {
      for (int x = 0; x < depth.width; ++x) {
        const auto pixel = UndistortPixel(camera, {x + 0.5, y + 0.5});
        const double metres = depth.At(x, y);
        if (!pixel || !std::isfinite(metres)) continue;
        const double down = (pixel->y - in.cy) / in.fy, across = (pixel->x - in.cx - in.skew * down) / in.fx;
        points_.At(x, y) = metres * glm::dvec3(across, down, 1);
      }
    }
  }

  std::optional<glm::dvec3> At(int x, int y) const {
    if (!points_.Contains(x, y) || points_.At(x, y).z == 0) return std::nullopt;
    return points_.At(x, y);
  }

  /// Returns a step along the surface in the direction (right, down): the vector to the next pixel's point or the
  /// vector from the previous pixel's point, whichever changes the depth less. Returns nullopt if this pixel or both
  /// neighbours have no point.
  std::optional<glm::dvec3> StepAt(int x, int y, int right, int down) const {
    const auto here = At(x, y), next = At(x + right, y + down), before = At(x - right, y - down);
    if (!here || (!next && !before)) return std::nullopt;
    if (!before || (next && std::abs(next->z - here->z) <= std::abs(here->z - before->z))) return *next - *here;
    return *here - *before;
  }

 private:
  Image<glm::dvec3> points_;  ///< zero where no surface is visible
};

}  // namespace

NormalImage NormalsOf(const DepthImage& depth, const Camera& camera) {
  const Points points(depth, camera);
  const glm::dmat3 R_WC = glm::transpose(camera.R_CW);
  NormalImage normals(depth.width, depth.height, glm::vec3(0));
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const auto across = points.StepAt(x, y, 1, 0), down = points.StepAt(x, y, 0, 1);
      if (!across || !down) continue;
      glm::dvec3 normal_C = glm::cross(*down, *across);
      if (glm::dot(normal_C, *points.At(x, y)) > 0) normal_C = -normal_C;
      normals.At(x, y) = glm::vec3(R_WC * glm::normalize(normal_C));
    }
  }
  return normals;
}

}  // namespace etude
