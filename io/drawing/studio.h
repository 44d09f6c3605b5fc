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

/// The part of the camera's view that must be visible. Points are tangents of the angles from the viewing axis: x to
/// the right, y down.
struct ViewBounds {
  glm::dvec2 low{1e9};
  glm::dvec2 high{-1e9};
};

/// An endless floor with grid lines every 0.5 m, seen by a fixed camera in front of the origin, at +Z. The camera does
/// not move; bodies are moved to the origin instead (FloorMove), and the grid moves under a walker.
class Studio {
 public:
  /// Widens `bounds` so that the view contains a figure that FloorMove has moved.
  static void Include(const Figure& placed, ViewBounds& bounds);

  /// Makes a studio for pictures of this size that show `bounds` as large as possible. Pictures are drawn `detail`
  /// times larger and then shrunk: A `detail` of 2 smooths the edges; smaller values are faster.
  Studio(int width, int height, double detail, const ViewBounds& bounds);

  /// Draws a figure that `placement` has moved; the grid moves with it. `ghost` is the Silhouette of another figure,
  /// which is drawn behind the first figure and shows through it (null = no ghost). The box has the studio's size and
  /// begins at a whole pixel. Parts that have not changed since the last picture are not drawn again.
  void Draw(Canvas& canvas, const Box& box, Renderer& renderer, const Figure& placed, const FloorMove& placement,
            const Mask* ghost = nullptr);
  /// Returns the pixels that a moved figure covers, at the studio's internal resolution (`detail`).
  Mask Silhouette(Renderer& renderer, const Figure& placed) const;
  /// Returns the pixel of the canvas at which the camera sees a point.
  glm::dvec2 PixelOf(const Box& box, const glm::dvec3& point) const;

 private:
  /// For each pixel, the point at which the pixel's ray hits the floor, and further numbers; each vector has one number
  /// per pixel.
  struct Floor {
    std::vector<float> x, z;       ///< metres
    std::vector<float> fade;       ///< visibility of the floor at this point, 0…1; 0 shows only the backdrop
    std::vector<float> footprint;  ///< width of one pixel on the floor, metres
    PixelRect seen{};              ///< rectangle outside which only the backdrop is visible
  };

  void PaintFloor(const FloorMove& placement);
  void Compose(const PixelRect& rect, const Mask* ghost);

  Camera camera_;  ///< the camera of the enlarged pictures
  Floor floor_;
  std::optional<FloorMove> painted_;    ///< the placement for which lit_ and shaded_ were painted
  Image<std::uint32_t> lit_, shaded_;   ///< the empty studio in light and in shadow
  Overlay figures_;                     ///< the figures of the last picture
  bool has_ghost_ = false;              ///< true if the last picture showed a ghost
  Image<std::uint32_t> large_, small_;  ///< the last picture, before and after shrinking
  Shrinker shrinker_;
};

/// Turns a figure about the vertical axis and moves the figure on the floor.
Figure Placed(Figure figure, const FloorMove& move);

/// Computes the path that the camera follows, one point per frame: the hip centre, averaged over `smoothing` frames to
/// either side. If the hip centre stays within 45 cm of its middle position along x and z, the camera stands still.
/// Needs at least one frame.
std::vector<glm::dvec3> CameraPath(const BodyMotion& motion, int smoothing);

}  // namespace etude
