#pragma once

// What is drawn: plain data, without a renderer.

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/base/image.h"
#include "sim/body/shape.h"

namespace etude {

/// A pattern says how two colours share a surface; those from kPlanks on are for rooms only, on figures they are plain.
/// Places are metres in the surface's own space: of clothes the body at rest (so that patterns move with it), of a wall
/// or floor its plane, of furniture the box.
enum class Pattern {
  kPlain,      ///< the first colour
  kBands,      ///< level bands, `size` apart
  kStripes,    ///< upright stripes, `size` apart
  kChecks,     ///< bands over stripes
  kTwoTone,    ///< the second colour below the height `size`
  kPlanks,     ///< boards of width `size`, each a tone of its own
  kTiles,      ///< squares of side `size`, each a tone of its own, joints between
  kSpeckle,    ///< grains of `size`: carpet, plaster, bark
  kPatchwork,  ///< blocks of `size`, each somewhere between the two colours: books, pictures
};

/// A painted surface.
struct SurfacePaint {
  Rgb8 first{};
  Rgb8 second{};
  Pattern pattern = Pattern::kPlain;
  double size = 0.1;         ///< metres
  glm::dvec2 patch{0};       ///< x and y of the middle of a patch of the second colour, in front (z > 0)
  glm::dvec2 patch_half{0};  ///< half its width and height; 0: no patch
  bool is_cloth = false;     ///< with seams and creases
  friend bool operator==(const SurfacePaint&, const SurfacePaint&) = default;
};

/// The colours of the parts of a body, indexed by the number of the Part.
using PartColours = std::array<Rgb8, 16>;

/// Triangles in the world, of one colour, or with a paint, or with a texture. Both sides are drawn. Triangles with a
/// corner or normal that is not finite, or a corner 1000 km away, are left out; what is nearer to the camera than 1 cm
/// is cut off.
struct Surface {
  std::vector<glm::dvec3> positions;                    ///< metres
  std::vector<glm::dvec3> normals;                      ///< unit, one per position
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
  std::vector<Part> parts;                              ///< one per triangle: its number in label images
  Rgb8 colour;
  std::optional<PartColours> by_part{};  ///< in place of `colour`: each triangle has its part's
  std::optional<SurfacePaint> paint{};   ///< in place of `colour`
  bool is_closed = false;                ///< no back of it is ever in sight: drawn faster
  std::vector<glm::vec3> rest{};         ///< with `paint`, one per position: where it is on the body at rest, metres
  SharedTexture texture{};               ///< in place of `colour`, where there is no paint
  std::vector<glm::vec2> on_texture{};   ///< with `texture`, one per position
};

/// A person or a moving thing in the scene: capsules and the colour of each part, or surfaces, or both.
struct Figure {
  std::vector<Capsule> shape;
  PartColours colours{};
  std::vector<Surface> surfaces{};
  /// Invisible capsules that throw the shadow of the surfaces in furnished rooms, where surfaces throw none themselves.
  std::vector<Capsule> shadow{};
  /// The label of all its pixels in place of its parts: kBystander or kClutter.
  std::optional<Part> seen_as{};
  bool is_hooded = false;  ///< neither hair nor a face is drawn on its capsules' head
};

/// The most painted surfaces that one picture shows.
constexpr std::size_t kMostPaints = 64;

/// Returns the colours of the captured performer: clothes and skin of warm hues (335° over red to 45°), at least 85° of
/// hue away from anything in the room, because segmentation compares hues.
PartColours PerformerColours();

/// A box that stands in the room all the time, turned about the vertical; its pixels are kFurniture. As
/// sim/body/cuboid.h has it.
struct FurnitureBox {
  glm::dvec3 centre{0};     ///< metres
  glm::dvec3 half_size{0};  ///< along its own axes
  double heading = 0;       ///< radians: its own +Z points to (sin heading, 0, cos heading)
  SurfacePaint paint;
};

/// A picture or a window: a rectangle painted on a wall; its pixels are the wall's.
struct WallPicture {
  enum class Wall { kBack, kLeft, kRight };  ///< z = low.z, x = low.x, x = high.x
  Wall wall = Wall::kBack;
  glm::dvec2 centre{0};     ///< metres: along the wall (x, or z of a side wall), above the floor
  glm::dvec2 half_size{0};  ///< metres, its frame included
  SurfacePaint paint;
  Rgb8 frame{};
  double glow = 0;  ///< light of its own: 1 = a window at noon shows its paint whatever the lamps do
};

/// The lights of an interior, in shares of the studio's lamp and ambient light. Linear RGB.
struct Lights {
  glm::dvec3 key{-1.8, 2.9, 4.0};  ///< where the lamp that throws shadows hangs, metres
  glm::dvec3 key_colour{1};
  glm::dvec3 ambient_colour{1};
  glm::dvec3 fill{1, 0, 0};  ///< towards a wide, weak light without shadows: unit
  glm::dvec3 fill_colour{0};
  glm::dvec3 window{0};  ///< the middle of the window, metres
  glm::dvec3 window_colour{0};
};

/// The most that one interior holds; more are not drawn.
constexpr std::size_t kMostFurnitureBoxes = 48;
constexpr std::size_t kMostWallPictures = 8;

/// A furnished room: a closed box, painted, with what stands in it. Walls are seen from inside only, so a camera may
/// stand behind one.
struct Interior {
  glm::dvec3 low{-4, 0, -2.5};  ///< its corners, metres
  glm::dvec3 high{4, 3.3, 5};
  SurfacePaint floor, wall, ceiling;
  Rgb8 skirting{};
  double studio = 0;  ///< how much of the walls and the floor still is the studio's paint: 1 = all
  glm::dvec4 rug{0};  ///< x, z of its middle, half its size along x and z; 0: none
  SurfacePaint rug_paint;
  Lights lights;
  std::vector<FurnitureBox> furniture;
  std::vector<WallPicture> pictures;
};

bool operator==(const Lights&, const Lights&);
bool operator==(const Interior&, const Interior&);

/// The room's wall is the plane z = kWallZ, endless and seen from its front only; the floor is y = 0.
constexpr double kWallZ = -2.5;
/// The position of the studio's one lamp, metres.
constexpr glm::dvec3 kLamp{-1.8, 2.9, 4.0};

/// The room: a floor at y = 0 and a wall behind, both textured, lit by one lamp that casts shadows; or an interior.
struct Room {
  std::uint64_t texture_seed = 1;  ///< where the spots of the wall and floor lie
  double brightness = 1.0;         ///< multiplies the light: exposure or lamp drift, hue kept; ≥ 0
  bool casts_shadows = true;
  const Interior* interior = nullptr;  ///< null: the studio. Must live until the picture is drawn.
};

struct View {
  ColourImage colour;
  LabelImage labels;  ///< Part numbers; kShadow where the floor or wall lies in a figure's shadow
  DepthImage depth;   ///< metres along the viewing axis; infinity where only the clear colour is seen
};

/// A rectangle of pixels left ≤ x < right, top ≤ y < bottom.
struct PixelRect {
  int left = 0, top = 0, right = 0, bottom = 0;
  int Width() const { return right - left; }
  int Height() const { return bottom - top; }
  bool IsEmpty() const { return right <= left || bottom <= top; }
};

/// Returns the smallest rectangle that holds both; an empty one holds nothing.
PixelRect Union(const PixelRect& a, const PixelRect& b);

/// The pixels that figures alone show, for pictures whose ground is somebody else's.
struct Overlay {
  /// The fourth byte: what is seen in a pixel.
  enum Seen : std::uint8_t { kBody = 0, kShadow = 128, kNothing = 255 };

  int width = 0, height = 0;
  std::vector<std::uint8_t> bytes;  ///< four a pixel: red, green, blue (of a body), and what is seen
  PixelRect drawn{};                ///< everything outside is kNothing
};

/// Rows `first` to `end` − 1 of a picture.
struct RowRange {
  int first = 0;
  int end = 0;
};

/// The pictures that a caller needs: colour alone is the fastest; pictures that are not needed are left empty.
enum class Targets { kColour, kColourAndLabels, kAll };

/// The largest picture, pixels per side.
constexpr int kLargestPicture = 4096;

/// Returns the lights of the studio, or of the room's interior.
Lights LightsOf(const Room& room);

}  // namespace etude
