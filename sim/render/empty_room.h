#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/cameras/camera.h"
#include "sim/render/gl_context.h"
#include "sim/render/scene.h"

namespace etude {

/// The differences between the 64 tiles of floor or wall: x, y = centre of a round spot within the tile (0…1), z = its
/// radius (0 = none; the spot stays inside the tile), w = tone of the tile, 0…1.
using TilePattern = std::array<glm::vec4, 64>;

/// The patterns of the room's two surfaces; tile (i, j) uses entry (i mod 8) + 8 (j mod 8).
struct RoomTexture {
  TilePattern floor;
  TilePattern wall;
};

/// Draws the patterns of a room; they depend on `seed` alone.
RoomTexture MakeRoomTexture(std::uint64_t seed);

/// The side of a tile, pixels, at most: small enough to follow shadows closely, though each tile costs a look at every
/// body.
constexpr int kRoomTileSize = 16;

/// A tile of the picture, and the directions in which the lamp sees what the empty room shows there. Directions are
/// unit vectors from the lamp.
struct RoomTile {
  PixelRect pixels;
  glm::dvec3 middle{0};  ///< of the directions
  double spread = 0;     ///< the largest distance of a direction's tip from that of `middle`
  double farthest = 0;   ///< from the lamp, metres
  glm::dvec3 centre{0};  ///< of a ball around the points, metres from the lamp
  double radius = 0;     ///< of that ball
};

/// The points that a picture of the empty room shows, seen from the lamp: one number per pixel, row by row.
struct LampView {
  glm::dvec3 lamp{0};           ///< in the world, metres
  std::vector<float> x, y, z;   ///< from the lamp, along the world's axes, metres; of no room: next to the lamp
  std::vector<RoomTile> tiles;  ///< the picture, but for tiles without room
};

/// The empty room as one camera sees it at brightness 1, as textures for shaders and as numbers for what needs none.
struct KeptRoom {
  GLuint room = 0;                   ///< RGB colour, A depth
  GLuint extra = 0;                  ///< RGB the lamp's share of the light, A label
  std::vector<float> colours;        ///< RGB, three per pixel
  std::vector<float> lamp_shares;    ///< likewise: of the light, how much is the lamp's
  std::vector<float> depths;         ///< metres
  std::vector<std::uint8_t> labels;  ///< one per pixel
  LampView lamp;
};

/// Pictures of the empty room, one per camera, because cameras stand still while people move. The few last used are
/// kept.
class KeptRooms {
 public:
  /// The programs draw the studio and interiors (shaders.h) and outlive this; so does `empty_vertices`, a
  /// vertex array without attributes.
  KeptRooms(const GlFunctions& gl, GLuint studio_program, GLuint interior_program, GLuint empty_vertices)
      : gl_(gl),
        studio_program_(studio_program),
        interior_program_(interior_program),
        empty_vertices_(empty_vertices) {}
  ~KeptRooms();
  KeptRooms(const KeptRooms&) = delete;
  KeptRooms& operator=(const KeptRooms&) = delete;

  /// Returns the room seen by `camera`, drawn now or kept. Changes GL's framebuffer, viewport and program when it has
  /// to draw.
  const KeptRoom& FindOrDraw(const Room& room, const Camera& camera);

 private:
  struct Kept {
    std::uint64_t texture_seed;
    std::optional<Interior> interior;
    Camera camera;
    KeptRoom picture;
  };
  KeptRoom Draw(const Room& room, const Camera& camera);
  void Drop(const Kept& kept);

  const GlFunctions& gl_;
  GLuint studio_program_, interior_program_;
  GLuint empty_vertices_;
  std::deque<Kept> kept_;  // the last used first
};

/// Fills `view` with those rows of the empty room at `brightness`, `width` pixels each: the very bytes that GL draws
/// (round to nearest even). Pictures of another size are made anew.
void FillBackdrop(const KeptRoom& room, int width, double brightness, Targets targets, const RowRange& rows,
                  View& view);

/// Writes the 8-bit levels of `count` numbers times the brightness, rounded as GL rounds them.
void RoundToBytes(const float* light, std::size_t count, float brightness, std::uint8_t* bytes);

}  // namespace etude
