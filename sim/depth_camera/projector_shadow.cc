#include "sim/depth_camera/projector_shadow.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/depth_camera/depth_edges.h"

namespace etude {
namespace {

/// One row of pixels as the projector would see them.
class Row {
 public:
  Row(const DepthImage& depth, const Camera& camera, double baseline_m, int y)
      : y_(y), depth_(depth), pixels_(static_cast<std::size_t>(depth.width)) {
    const Intrinsics& in = camera.intrinsics;
    for (int x = 0; x < depth.width; ++x) {
      const auto pixel = UndistortPixel(camera, {x + 0.5, y + 0.5});
      Pixel& made = pixels_[static_cast<std::size_t>(x)];
      made.disparity = in.fx * baseline_m / depth.At(x, y);
      made.camera_column = pixel ? pixel->x : x + 0.5;
      most_ = std::max(most_, made.disparity);
    }
    for (int x = 0; x < depth.width; ++x) SetExtent(x);
  }

  /// Whether the light on its way to a pixel's middle meets a nearer pixel's surface. Such a pixel lies to the right,
  /// by as many columns as its disparity is larger.
  bool IsUnlit(int x) const {
    const Pixel& here = pixels_[static_cast<std::size_t>(x)];
    const double column = here.ProjectorColumn();
    for (std::size_t i = static_cast<std::size_t>(x) + 1; i < pixels_.size(); ++i) {
      const Pixel& other = pixels_[i];
      if (other.first - most_ > column) break;
      if (other.disparity > here.disparity && other.from <= column && column < other.to) return true;
    }
    return false;
  }

 private:
  struct Pixel {
    double camera_column = 0, disparity = 0;
    double first = 0;         ///< its left border in the camera's picture
    double from = 0, to = 0;  ///< the projector's columns that it covers
    double ProjectorColumn() const { return camera_column - disparity; }
  };

  // A pixel reaches half way to a neighbour on the same surface, beside an edge half a pixel.
  void SetExtent(int x) {
    Pixel& pixel = pixels_[static_cast<std::size_t>(x)];
    const auto border = [&](int side) {
      const int next = x + side;
      if (!depth_.Contains(next, y_) || IsDepthEdge(depth_.At(x, y_), depth_.At(next, y_))) {
        return pixel.ProjectorColumn() + 0.5 * side;
      }
      return (pixel.ProjectorColumn() + pixels_[static_cast<std::size_t>(next)].ProjectorColumn()) / 2;
    };
    const auto [from, to] = std::minmax({border(-1), border(1)});
    pixel.first = pixel.camera_column - 0.5;
    pixel.from = from;
    pixel.to = to;
  }

  int y_;
  const DepthImage& depth_;
  std::vector<Pixel> pixels_;
  double most_ = 0;  ///< the largest disparity
};

}  // namespace

Mask ProjectorShadow(const DepthImage& depth, const Camera& camera, double baseline_m) {
  Mask unlit(depth.width, depth.height);
  if (baseline_m == 0) return unlit;
  for (int y = 0; y < depth.height; ++y) {
    const Row row(depth, camera, baseline_m, y);
    for (int x = 0; x < depth.width; ++x) {
      if (std::isfinite(depth.At(x, y))) unlit.At(x, y) = row.IsUnlit(x);
    }
  }
  return unlit;
}

}  // namespace etude
