#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "sim/render/scene.h"

namespace etude {

/// Draws rooms and people offscreen with Mesa's llvmpipe. It is not thread-safe; one renderer per process is enough,
/// for cameras of any size.
class Renderer {
 public:
  /// Makes a renderer. Fails with the reason if no GL context can be made.
  static Result<std::unique_ptr<Renderer>> Create();
  ~Renderer();

  /// Draws `figures` (none = the background picture) in `room`, seen by `camera`. In the pinned environment the bytes
  /// are the same every time. The pixel geometry is that of `Project`, without antialiasing: a triangle covers the
  /// pixels whose centres it contains. Pictures have 1 to `kMaxPictureSide` pixels a side. The camera must be above the
  /// floor and in front of the wall; up to about 55° to the side, every pixel then shows floor, wall or a figure.
  View Render(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets);

  /// Draws only some rows of that picture, with the same bytes; the view's height is the number of rows. A rolling
  /// shutter sees each band of rows at another time.
  View RenderRows(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets,
                  const RowRange& rows);

  /// Draws figures as in the studio and marks their shadows on its floor, without the room. An overlay of the right
  /// size is reused.
  void DrawFigures(const std::vector<Figure>& figures, const Camera& camera, Overlay& overlay);

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Returns the one renderer of this process, made at the first call, because compiling its shaders takes longer than
/// drawing a hundred pictures. Like every renderer it is for one thread at a time; its pictures do not depend on
/// earlier ones.
Result<Renderer*> SharedRenderer();

/// Fails if the environment variable ETUDE_GL, by which a user chooses the GL library, is neither "osmesa" nor "egl".
Result<void> CheckRendererChoice();

/// Loads the drawing library, so that it appears among the libraries of this process; otherwise it is loaded at the
/// first drawing. Fails with the reason if it cannot be loaded.
Result<void> LoadRenderer();

/// Returns the version of OpenGL and Mesa, on which pixels depend, and the library used ("4.5 (Core Profile) Mesa
/// 22.3.6, by OSMesa"), or the reason why there is no context.
std::string RendererVersion();

}  // namespace etude
