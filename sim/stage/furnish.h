#pragma once

#include <cstdint>
#include <span>

#include "engine/cameras/camera.h"
#include "sim/render/scene.h"

namespace etude {

/// The part of the floor that the performer needs. No piece of furniture stands on this floor.
struct FreeFloor {
  glm::dvec2 low{0}, high{0};  ///< corners of the free floor (x, z), metres
};

/// The positions of the room's moving objects.
struct MoverPositions {
  glm::dvec3 plant{0};  ///< position of the top of the pot
  bool has_plant = false;
  FurnitureBox screen;  ///< the box of the screen; the front of the box (+Z) shows the picture
  bool has_screen = false;
};

struct FurnishedRoom {
  Interior interior;
  MoverPositions places;
};

/// Furnishes the room with this seed. Each piece has its own random numbers and its own threshold of `scene`: every
/// piece present at a low value is also present at a higher one. Colours are interpolated by `colour_share` between the
/// studio's colours (0) and the colours of everyday objects (1).
FurnishedRoom Furnish(std::uint64_t seed, double scene, double colour_share, const FreeFloor& free,
                      std::span<const Camera> cameras);

}  // namespace etude
