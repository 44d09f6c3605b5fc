#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "sim/body/shape.h"

namespace etude {

/// A person in the scene: its shape and the colour of each part.
struct Figure {
  std::vector<Capsule> shape;
  std::array<Rgb8, 16> colours{};  ///< by Part
};

/// The colours of the captured performer: clothes whose hues stand apart from the room's.
std::array<Rgb8, 16> PerformerColours();
/// The colours of the coach.
std::array<Rgb8, 16> CoachColours();

/// The room: a floor at y = 0 and a wall behind, both textured, lit by one lamp that casts shadows.
struct Room {
  std::uint64_t texture_seed = 1;  ///< where the spots of the wall and floor lie
  double brightness = 1.0;         ///< multiplies the light: exposure or lamp drift, hue kept
  bool casts_shadows = true;
};

struct View {
  ColourImage colour;
  LabelImage labels;  ///< Part numbers; kShadow where the floor or wall lies in the body's shadow
  DepthImage depth;   ///< metres along the viewing axis; infinity where only the clear colour is seen
};

/// Which pictures a caller needs; colour alone is the fastest.
enum class Targets { kColour, kAll };

/// Draws rooms and people offscreen with OSMesa (the one door to GL). Not thread-safe: one renderer
/// per process is enough, it can be used for cameras of any size.
class Renderer {
 public:
  /// Fails when no GL context can be made, saying why.
  static Result<std::unique_ptr<Renderer>> Create();
  ~Renderer();

  /// Draws `figures` (none = the background picture) in `room`, seen by `camera`. The same bytes every
  /// time in the pinned environment (design.md §6). Pixel geometry is `Project`'s.
  View Render(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets);

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace etude
