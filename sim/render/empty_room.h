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

/// The 64 different tiles of a floor or wall. For each tile: x, y = centre of a round spot within the tile (0…1); z =
/// the spot's radius (0 = no spot; a spot stays inside its tile); w = tone of the tile, 0…1.
using TilePattern = std::array<glm::vec4, 64>;

/// The tile patterns of floor and wall. Tile (i, j) uses entry (i mod 8) + 8 (j mod 8).
struct RoomTexture {
  TilePattern floor;
  TilePattern wall;
};

/// Draws the random patterns of a room. The patterns depend only on `seed`.
RoomTexture MakeRoomTexture(std::uint64_t seed);

/// The maximum side of a tile, pixels. Smaller tiles fit shadows more closely, but every tile is tested against every
/// body.
constexpr int kRoomTileSize = 16;

/// A tile of the picture. Its directions are the unit vectors from the lamp to those points of the empty room that the
/// tile shows.
struct RoomTile {
  PixelRect pixels;
  glm::dvec3 middle{0};  ///< mean direction, unit
  double spread = 0;     ///< maximum distance between the end points of `middle` and of one of the directions
  double farthest = 0;   ///< maximum distance of a point from the lamp, metres
  glm::dvec3 centre{0};  ///< centre of a ball around the points, relative to the lamp, metres
  double radius = 0;     ///< radius of that ball, metres
};

/// The points of the empty room that a picture shows, relative to the lamp: one value per pixel, row by row.
struct LampView {
  glm::dvec3 lamp{0};           ///< position of the lamp in the world, metres
  std::vector<float> x, y, z;   ///< points relative to the lamp, world axes, metres; 1 mm above the lamp: no room there
  std::vector<RoomTile> tiles;  ///< the tiles in which the room is visible
};

/// One camera's picture of the empty room at brightness 1: as textures for shaders, and as numbers for computations
/// without GL.
struct KeptRoom {
  GLuint room = 0;                   ///< texture: RGB = colour, A = depth
  GLuint extra = 0;                  ///< texture: RGB = the lamp's share of the light, A = label
  std::vector<float> colours;        ///< RGB, three numbers per pixel
  std::vector<float> lamp_shares;    ///< three numbers per pixel: the lamp's share of the light's red, green and blue
  std::vector<float> depths;         ///< metres
  std::vector<std::uint8_t> labels;  ///< one label per pixel
  LampView lamp;
};

/// Caches pictures of the empty room, one per camera, because cameras stand still while people move. The most recently
/// used pictures are kept.
class KeptRooms {
 public:
  /// `studio_program` draws the studio, and `interior_program` draws interiors (shaders.h). Both programs and
  /// `empty_vertices`, a vertex array without attributes, must outlive this object.
  KeptRooms(const GlFunctions& gl, GLuint studio_program, GLuint interior_program, GLuint empty_vertices)
      : gl_(gl),
        studio_program_(studio_program),
        interior_program_(interior_program),
        empty_vertices_(empty_vertices) {}
  ~KeptRooms();
  KeptRooms(const KeptRooms&) = delete;
  KeptRooms& operator=(const KeptRooms&) = delete;

  /// Returns the picture of the room from `camera`, from the cache or newly drawn. Drawing changes GL's framebuffer,
  /// viewport and program.
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
  std::deque<Kept> kept_;  // pictures, the most recently used first
};

/// Fills `view` with `rows` of the empty room at `brightness`; each row has `width` pixels. The bytes are exactly those
/// that GL would draw (round to nearest even). Pictures in `view` are reallocated if their size differs.
void FillBackdrop(const KeptRoom& room, int width, double brightness, Targets targets, const RowRange& rows,
                  View& view);

/// Multiplies `count` values by the brightness and converts them to 8-bit levels; rounding is the same as in GL.
void RoundToBytes(const float* light, std::size_t count, float brightness, std::uint8_t* bytes);

}  // namespace etude
