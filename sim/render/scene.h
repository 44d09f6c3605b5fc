#pragma once

// This file describes a scene as plain data, independent of the renderer.

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/base/image.h"
#include "sim/body/shape.h"

namespace etude {

/// The pattern in which two colours cover a surface. Patterns from kPlanks on are for rooms only; figures show the
/// first colour instead. Positions are in metres in the surface's own space: the body at rest for clothes, whose
/// patterns therefore move with the body; the plane of a wall or floor; the box of a piece of furniture.
enum class Pattern {
  kPlain,      ///< the first colour
  kBands,      ///< horizontal bands with period `size`
  kStripes,    ///< vertical stripes with period `size`
  kChecks,     ///< bands and stripes
  kTwoTone,    ///< the second colour below the height `size`
  kPlanks,     ///< boards of width `size`; each board has its own tone
  kTiles,      ///< squares of side `size`, each with its own tone, separated by dark lines
  kSpeckle,    ///< grains of `size`: carpet, plaster, bark
  kPatchwork,  ///< blocks of `size`, each a mix of the two colours: books, pictures
};

/// The paint of a surface: a pattern and its colours.
struct SurfacePaint {
  Rgb8 first{};
  Rgb8 second{};
  Pattern pattern = Pattern::kPlain;
  double size = 0.1;         ///< period, width or side of the pattern's parts, metres
  glm::dvec2 patch{0};       ///< x and y of the centre of a patch of the second colour, on the front (z > 0), metres
  glm::dvec2 patch_half{0};  ///< half the patch's width and height, metres; 0: no patch
  bool is_cloth = false;     ///< true: drawn with seams and creases
  friend bool operator==(const SurfacePaint&, const SurfacePaint&) = default;
};

/// The colours of the parts of a body, indexed by Part.
using PartColours = std::array<Rgb8, 16>;

/// Triangles in the world with one colour, a paint or a texture. Both sides are drawn. A triangle is left out if a
/// corner or a normal is not finite, or if a corner is 1000 km or more from the camera along an axis. Parts nearer than
/// 1 cm to the camera are clipped.
struct Surface {
  std::vector<glm::dvec3> positions;                    ///< metres
  std::vector<glm::dvec3> normals;                      ///< unit vectors, one per position
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< three positions each, counter-clockwise seen from outside
  std::vector<Part> parts;                              ///< one part per triangle: the label of the triangle's pixels
  Rgb8 colour;
  std::optional<PartColours> by_part{};  ///< colours of the parts, which replace `colour`
  std::optional<SurfacePaint> paint{};   ///< the paint, which replaces `colour`
  bool is_closed = false;                ///< true if no back side is ever visible, which makes drawing faster
  std::vector<glm::vec3> rest{};         ///< for `paint`: each position's place on the body at rest, metres
  SharedTexture texture{};               ///< the texture, which replaces `colour` unless there is a paint
  std::vector<glm::vec2> on_texture{};   ///< for `texture`: each position's texture coordinates
};

/// A person or a moving object in the scene: capsules with the colours of their parts, or surfaces, or both.
struct Figure {
  std::vector<Capsule> shape;
  PartColours colours{};
  std::vector<Surface> surfaces{};
  /// Invisible capsules that cast the figure's shadow in furnished rooms, because surfaces cast no shadow there.
  std::vector<Capsule> shadow{};
  /// If set, this label, kBystander or kClutter, replaces the part labels of all pixels of the figure.
  std::optional<Part> seen_as{};
  bool is_hooded = false;  ///< true: no hair and no face on the head's capsules
};

/// The maximum number of painted surfaces in one picture.
constexpr std::size_t kMaxPaints = 64;

/// Returns the colours of the captured performer: clothes and skin with warm hues (from 335° through red to 45°). These
/// colours differ in hue by at least 85° from everything in the studio, because segmentation compares hues.
PartColours PerformerColours();

/// A box that stands still in the room, rotated about the vertical like Cuboid (sim/body/shape.h). Its pixels are
/// labelled kFurniture.
struct FurnitureBox {
  glm::dvec3 centre{0};     ///< metres
  glm::dvec3 half_size{0};  ///< half sizes along the box's own axes
  double heading = 0;       ///< radians: the box's +Z axis points to (sin heading, 0, cos heading)
  SurfacePaint paint;
};

/// A picture or a window: a painted rectangle on a wall. Its pixels have the wall's label.
struct WallPicture {
  enum class Wall { kBack, kLeft, kRight };  ///< in order: the planes z = low.z, x = low.x, x = high.x
  Wall wall = Wall::kBack;
  glm::dvec2 centre{0};     ///< metres: along the wall (x, or z for a side wall), above the floor
  glm::dvec2 half_size{0};  ///< metres: half width and half height of picture and frame together
  SurfacePaint paint;
  Rgb8 frame{};
  double glow = 0;  ///< emitted light; 1: a window at noon, which looks the same under all lamps
};

/// The lights of an interior in linear RGB, relative to the studio's lamp and ambient light.
struct Lights {
  glm::dvec3 key{-1.8, 2.9, 4.0};  ///< position of the lamp that casts shadows, metres
  glm::dvec3 key_colour{1};
  glm::dvec3 ambient_colour{1};
  glm::dvec3 fill{1, 0, 0};  ///< unit direction towards a wide, weak light without shadows
  glm::dvec3 fill_colour{0};
  glm::dvec3 window{0};  ///< centre of the window, metres
  glm::dvec3 window_colour{0};
};

/// The maximum number of objects in an interior; more are not drawn.
constexpr std::size_t kMaxFurnitureBoxes = 48;
constexpr std::size_t kMaxWallPictures = 8;

/// A furnished room: a closed, painted box with its contents. Walls are visible only from inside, so a camera may stand
/// behind a wall.
struct Interior {
  glm::dvec3 low{-4, 0, -2.5};  ///< corners of the room, metres
  glm::dvec3 high{4, 3.3, 5};
  SurfacePaint floor, wall, ceiling;
  Rgb8 skirting{};
  double studio = 0;  ///< share of the studio's paint on walls and floor; 1: only the studio's paint
  glm::dvec4 rug{0};  ///< x, z of the rug's centre, half sizes along x and z, metres; all 0: no rug
  SurfacePaint rug_paint;
  Lights lights;
  std::vector<FurnitureBox> furniture;
  std::vector<WallPicture> pictures;
};

bool operator==(const Lights&, const Lights&);
bool operator==(const Interior&, const Interior&);

/// The studio's wall is the infinite plane z = kWallZ, which is visible only from the front. The floor is y = 0.
constexpr double kWallZ = -2.5;
/// The position of the studio's only lamp, metres.
constexpr glm::dvec3 kLamp{-1.8, 2.9, 4.0};

/// The room: either the studio, which has a floor at y = 0 and a wall behind the floor, textured and lit by one lamp
/// that casts shadows; or an interior.
struct Room {
  std::uint64_t texture_seed = 1;  ///< seed of the spots on wall and floor
  double brightness = 1.0;         ///< factor on the light (exposure, lamp drift), ≥ 0; does not change hues
  bool casts_shadows = true;
  const Interior* interior = nullptr;  ///< the interior; null: the studio. Must exist until the picture is drawn.
};

struct View {
  ColourImage colour;
  LabelImage labels;  ///< Part values; kShadow where a figure's shadow falls on floor or wall
  DepthImage depth;   ///< metres along the viewing axis; infinity where there is no surface
};

/// A rectangle of pixels left ≤ x < right, top ≤ y < bottom.
struct PixelRect {
  int left = 0, top = 0, right = 0, bottom = 0;
  int Width() const { return right - left; }
  int Height() const { return bottom - top; }
  bool IsEmpty() const { return right <= left || bottom <= top; }
};

/// Returns the smallest rectangle that contains both rectangles. An empty rectangle contains no pixels.
PixelRect Union(const PixelRect& a, const PixelRect& b);

/// The pixels of figures alone, which can be drawn over another background.
struct Overlay {
  /// The object that a pixel shows, stored as the pixel's fourth byte.
  enum Seen : std::uint8_t { kBody = 0, kShadow = 128, kNothing = 255 };

  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;  ///< four bytes per pixel: red, green and blue of a body, then Seen
  PixelRect drawn{};                ///< rectangle around the drawn pixels; every pixel outside is kNothing
};

/// The rows `first` to `end` − 1 of a picture.
struct RowRange {
  int first = 0;
  int end = 0;
};

/// The pictures that a caller requests. Colour alone is the fastest. Pictures that are not requested stay empty.
enum class Targets { kColour, kColourAndLabels, kAll };

/// The maximum side of a picture, pixels.
constexpr int kMaxPictureSide = 4096;

/// Returns the lights of the room's interior, or of the studio without an interior.
Lights LightsOf(const Room& room);

}  // namespace etude
