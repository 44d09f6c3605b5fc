#pragma once

#include <span>
#include <string>

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "io/drawing/canvas.h"
#include "sim/render/renderer.h"

namespace etude {

/// Draws a crowd with one camera. The bodies stand in rows on a square, each body around its own point of a grid.
class CrowdStage {
 public:
  /// Prepares pictures of `width` × `height` pixels; `renderer` must outlive this object.
  CrowdStage(int characters, int width, int height, Renderer& renderer);

  /// A character: a pose relative to the character's grid point. If `stands_out` is true, the whole body has one pale
  /// colour.
  struct Character {
    BodyPose pose;
    bool stands_out = false;
  };
  /// Draws a crowd with a caption of two lines. The crowd must not have more characters than the constructor's
  /// `characters`.
  Canvas Draw(std::span<const Character> crowd, const std::string& strong, const std::string& soft);

 private:
  glm::dvec3 GridPointOf(std::size_t character) const;

  int width_, height_;
  std::size_t side_;  ///< number of grid points per row
  Camera camera_;
  Renderer& renderer_;
};

}  // namespace etude
