#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "sim/body/shape.h"
#include "sim/render/interior.h"
#include "sim/render/surface_paint.h"

namespace etude {

/// One colour for every Part of a body, by its number.
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
  /// In furnished rooms surfaces throw no shadow themselves: these invisible capsules do it for them.
  std::vector<Capsule> shadow{};
  /// What all its pixels are labelled, in place of its parts: kBystander, kClutter.
  std::optional<Part> seen_as{};
  bool is_hooded = false;  ///< neither hair nor a face is drawn on its capsules' head
};

/// The most painted surfaces that one picture shows.
constexpr std::size_t kMostPaints = 64;

/// The colours of the captured performer: clothes and skin of warm hues (335° over red to 45°), at
/// least 85° of hue away from anything in the room, because segmentation compares hues.
PartColours PerformerColours();

/// The room's wall is the plane z = kWallZ, endless and seen from its front only; the floor is y = 0.
constexpr double kWallZ = -2.5;
/// Where the one lamp hangs, metres.
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

/// Rows `first` to `end` − 1 of a picture.
struct RowRange {
  int first = 0;
  int end = 0;
};

/// Which pictures a caller needs; colour alone is the fastest. The others are left empty.
enum class Targets { kColour, kColourAndLabels, kAll };

/// The largest picture, pixels per side.
constexpr int kLargestPicture = 4096;

/// Draws rooms and people offscreen with OSMesa (the one door to GL). Not thread-safe: one renderer
/// per process is enough, it can be used for cameras of any size.
class Renderer {
 public:
  /// Fails when no GL context can be made, saying why.
  static Result<std::unique_ptr<Renderer>> Create();
  ~Renderer();

  /// Draws `figures` (none = the background picture) in `room`, seen by `camera`. The same bytes every
  /// time in the pinned environment. Pixel geometry is `Project`'s, without smoothing of
  /// edges: a triangle has the pixels whose centres it covers. Pictures have 1 to `kLargestPicture` pixels a side. The
  /// camera stands above the floor and in front of the wall; up to about 55° to the side, every pixel then shows floor,
  /// wall or a figure.
  View Render(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets);

  /// Only those rows of that picture, the same bytes: the view is as high as there are rows. A rolling shutter sees
  /// each band of rows at another time.
  View RenderRows(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets,
                  const RowRange& rows);

  /// The same picture with smooth edges, for people to look at: drawn at twice the size and averaged,
  /// at about four times the cost. At most kLargestPicture / 2 wide and high.
  ColourImage RenderSmooth(const Room& room, const std::vector<Figure>& figures, const Camera& camera);

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// The one renderer of this process, made when first asked for: compiling its shaders takes longer than drawing a
/// hundred pictures. For one thread at a time, as every renderer; its pictures do not depend on what it drew before.
Result<Renderer*> SharedRenderer();

/// Loads what draws, so that it is among the libraries of this process; whoever draws does so anyway. Fails when it
/// cannot be loaded, saying why.
Result<void> LoadRenderer();

/// What draws, and its version, on which pixels depend: "4.5 (Core Profile) Mesa 22.3.6"; else why nothing draws.
std::string RendererVersion();

}  // namespace etude
