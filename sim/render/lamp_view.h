#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/cameras/camera.h"
#include "sim/render/touched_pixels.h"

namespace etude {

/// Pixels a side, at most: small enough to follow shadows closely, though each tile costs a look at every body.
constexpr int kRoomTileSize = 16;

/// A part of the picture, and where the lamp sees what the empty room shows there. Directions are unit vectors from the
/// lamp.
struct RoomTile {
  PixelRect pixels;
  glm::dvec3 middle{0};  ///< of the directions
  double spread = 0;     ///< the largest distance of a direction's tip from that of `middle`
  double farthest = 0;   ///< from the lamp, metres
  glm::dvec3 centre{0};  ///< of a ball around the points, metres from the lamp
  double radius = 0;     ///< of that ball
};

/// What a picture of the empty room shows, as the lamp has it before it. One number per pixel, row by row.
struct LampView {
  glm::dvec3 lamp{0};           ///< in the world, metres
  std::vector<float> x, y, z;   ///< from the lamp, along the world's axes, metres; of no room: next to the lamp
  std::vector<RoomTile> tiles;  ///< the picture, but for tiles without room
};

/// `depths`: metres, infinite where there is no room.
LampView SeeFromLamp(const std::vector<float>& depths, const Camera& camera, const glm::dvec3& lamp);

}  // namespace etude
