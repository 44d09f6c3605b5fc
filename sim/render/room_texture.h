#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

namespace etude {

/// What makes one tile of floor or wall differ from the next: x, y = centre of a round spot within the
/// tile (0…1), z = its radius (0 = none; the spot stays inside the tile), w = tone of the tile, 0…1.
using TilePattern = std::array<glm::vec4, 64>;

/// The patterns of the room's two surfaces; tile (i, j) uses entry (i mod 8) + 8 (j mod 8).
struct RoomTexture {
  TilePattern floor;
  TilePattern wall;
};

/// Depends on `seed` alone.
RoomTexture MakeRoomTexture(std::uint64_t seed);

}  // namespace etude
