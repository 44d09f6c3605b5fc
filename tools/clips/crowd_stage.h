#pragma once

#include <span>
#include <string>

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "io/drawing/canvas.h"
#include "sim/render/renderer.h"

namespace etude {

/// Draws a crowd: so many bodies in rows on a square, each about its own place, all before one camera.
class CrowdStage {
 public:
  /// Sets the stage for pictures of this size in pixels; `renderer` must outlive it.
  CrowdStage(int characters, int width, int height, Renderer& renderer);

  /// A character: a pose about the floor's origin; who stands out is all of one pale colour.
  struct Character {
    BodyPose pose;
    bool stands_out = false;
  };
  /// Draws a crowd, at most as many as there are places, with a caption of two lines.
  Canvas Draw(std::span<const Character> crowd, const std::string& strong, const std::string& soft);

 private:
  glm::dvec3 PlaceOf(std::size_t character) const;

  int width_, height_;
  std::size_t side_;  ///< places of a row
  Camera camera_;
  Renderer& renderer_;
};

}  // namespace etude
