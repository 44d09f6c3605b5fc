#include "sim/render/room_texture.h"

#include "sim/random/stream.h"

namespace etude {
namespace {

TilePattern MakePattern(RandomStream& random, double spot_share) {
  TilePattern pattern;
  for (glm::vec4& tile : pattern) {
    const double radius = random.Uniform(0.12, 0.34);
    const double x = random.Uniform(radius, 1 - radius);
    const double y = random.Uniform(radius, 1 - radius);
    const double tone = random.Uniform();
    const bool has_spot = random.Chance(spot_share);
    tile = {x, y, has_spot ? radius : 0.0, tone};
  }
  return pattern;
}

}  // namespace

RoomTexture MakeRoomTexture(std::uint64_t seed) {
  const WorldKey key{seed, "room", 0};
  RandomStream floor(key, "floor-texture");
  RandomStream wall(key, "wall-texture");
  return {MakePattern(floor, 0.25), MakePattern(wall, 0.45)};
}

}  // namespace etude
