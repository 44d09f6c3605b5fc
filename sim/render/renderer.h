#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "sim/render/scene.h"

namespace etude {

/// Draws rooms and people offscreen with Mesa's llvmpipe (the one door to GL). Not thread-safe: one renderer
/// per process is enough, it can be used for cameras of any size.
class Renderer {
 public:
  /// Makes a renderer. Fails when no GL context can be made, saying why.
  static Result<std::unique_ptr<Renderer>> Create();
  ~Renderer();

  /// Draws `figures` (none = the background picture) in `room`, seen by `camera`. The same bytes every
  /// time in the pinned environment. Pixel geometry is `Project`'s, without smoothing of
  /// edges: a triangle has the pixels whose centres it covers. Pictures have 1 to `kLargestPicture` pixels a side. The
  /// camera stands above the floor and in front of the wall; up to about 55° to the side, every pixel then shows floor,
  /// wall or a figure.
  View Render(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets);

  /// Draws only some rows of that picture, with the same bytes: the view is as high as there are rows. A rolling
  /// shutter sees each band of rows at another time.
  View RenderRows(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets,
                  const RowRange& rows);

  /// Draws figures as they look in the studio, and marks where their shadows fall on its floor; the room is not drawn.
  /// An overlay of this size is used again.
  void DrawFigures(const std::vector<Figure>& figures, const Camera& camera, Overlay& overlay);

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Returns the one renderer of this process, made when first asked for: compiling its shaders takes longer than drawing
/// a hundred pictures. For one thread at a time, as every renderer; its pictures do not depend on what it drew before.
Result<Renderer*> SharedRenderer();

/// Fails when the variable ETUDE_GL, by which a user chooses how GL is reached, holds neither "osmesa" nor "egl".
Result<void> CheckRendererChoice();

/// Loads what draws, so that it is among the libraries of this process; whoever draws does so anyway. Fails when it
/// cannot be loaded, saying why.
Result<void> LoadRenderer();

/// Returns the version of OpenGL and Mesa, on which pixels depend, and how they were reached ("4.5 (Core Profile) Mesa
/// 22.3.6, by OSMesa"), or the reason why there is no context.
std::string RendererVersion();

}  // namespace etude
