#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/base/image.h"
#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "io/drawing/canvas.h"
#include "io/drawing/pixel_lanes.h"
#include "sim/render/renderer.h"

namespace etude {

/// The part of the camera's view that has to be shown: tangents to the right and downwards of its axis.
struct ViewBounds {
  glm::dvec2 low{1e9};
  glm::dvec2 high{-1e9};
};

/// An endless floor with a grid of half metres, seen by a camera that stands still before the origin, at +Z. Bodies are
/// put there (FloorMove) instead of moving the camera: the grid passes below a walker.
class Studio {
 public:
  /// Widens `bounds` so that it holds a figure that was put in place.
  static void Include(const Figure& placed, ViewBounds& bounds);

  /// Makes a studio for pictures of this size that show `bounds`, as large as it fits. They are drawn `detail` times as
  /// large and shrunk: 2 makes edges smooth, less is faster.
  Studio(int width, int height, double detail, const ViewBounds& bounds);

  /// Draws a figure that `placement` has put in place; the grid moves with it. `ghost` (null = none), a Silhouette of
  /// another figure, shimmers behind this one. The box has the studio's size and begins at a whole pixel. What has not
  /// changed since the last picture is not drawn again.
  void Draw(Canvas& canvas, const Box& box, Renderer& renderer, const Figure& placed, const FloorMove& placement,
            const Mask* ghost = nullptr);
  /// Gives the pixels, as fine as the studio draws, where a figure that was put in place is seen.
  Mask Silhouette(Renderer& renderer, const Figure& placed) const;
  /// Gives the place in the box where a point is seen.
  glm::dvec2 PixelOf(const Box& box, const glm::dvec3& point) const;

 private:
  /// The places where the rays of pixels meet the floor, one number per pixel.
  struct Floor {
    std::vector<float> x, z;       ///< metres
    std::vector<float> fade;       ///< how much the floor is still seen there; 0 for the backdrop
    std::vector<float> footprint;  ///< metres of floor below one pixel
    PixelRect seen{};              ///< outside is only backdrop
  };

  void PaintFloor(const FloorMove& placement);
  void Compose(const PixelRect& rect, const Mask* ghost);

  Camera camera_;  ///< of pictures drawn larger than shown, and shrunk
  Floor floor_;
  std::optional<FloorMove> painted_;    ///< how the floor lies in the next two
  Image<std::uint32_t> lit_, shaded_;   ///< the empty studio, in the light and in a shadow
  Overlay figures_;                     ///< of the last picture
  bool has_ghost_ = false;              ///< likewise
  Image<std::uint32_t> large_, small_;  ///< the last picture
  Shrinker shrinker_;
};

/// Turns a figure about the vertical axis and shifts it on the floor.
Figure Placed(Figure figure, const FloorMove& move);

/// Computes the way that a camera follows, for every frame: that of the hips, averaged over `smoothing` frames to
/// either side. It stands still, which is calmer, when the whole motion stays within 45 cm of its middle. Needs at
/// least one frame.
std::vector<glm::dvec3> CameraPath(const BodyMotion& motion, int smoothing);

}  // namespace etude
