#pragma once

#include <cstdint>
#include <span>

#include "engine/cameras/camera.h"
#include "sim/render/scene.h"

namespace etude {

/// The floor that the performer needs: no piece stands there.
struct FreeFloor {
  glm::dvec2 low{0}, high{0};  ///< x, z
};

/// The places of the room's moving things.
struct Places {
  glm::dvec3 plant{0};  ///< the top of its pot
  bool has_plant = false;
  FurnitureBox screen;  ///< its front (+Z) shows pictures
  bool has_screen = false;
};

struct FurnishedRoom {
  Interior interior;
  Places places;
};

/// Furnishes the room of this seed. Each piece has dice of its own and appears at its own threshold of `scene`, so that
/// what is there at 0.25 is there at 0.5; colours lie `colour_share` of the way from the studio's to those of everyday
/// things.
FurnishedRoom Furnish(std::uint64_t seed, double scene, double colour_share, const FreeFloor& free,
                      std::span<const Camera> cameras);

}  // namespace etude
