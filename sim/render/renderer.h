#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "sim/render/scene.h"

namespace etude {

/// Draws rooms and people offscreen with Mesa's llvmpipe. Not thread-safe. One renderer per process is enough, because
/// pictures of all sizes can be drawn with it.
class Renderer {
 public:
  /// Makes a renderer. Fails, with the reason, if no GL context can be made.
  static Result<std::unique_ptr<Renderer>> Create();
  ~Renderer();

  /// Draws `figures` in `room`, seen by `camera`; without figures, this is the background picture. In the pinned
  /// environment the bytes are the same every time. The pixel geometry is that of `Project`, without antialiasing: a
  /// triangle covers the pixels whose centres it contains. Pictures have 1 to `kMaxPictureSide` pixels a side. The
  /// camera must be above the floor and in front of the wall. Every pixel then shows floor, wall or a figure, if its
  /// ray points at most about 55° to the side.
  View Render(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets);

  /// Draws only some rows of the picture that Render draws, with the same bytes. The view's height is the number of
  /// rows. A rolling shutter needs this, because it takes each band of rows at another time.
  View RenderRows(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets,
                  const RowRange& rows);

  /// Draws figures with the studio's light, without the room, and marks the figures' shadows on the studio's floor. The
  /// memory of an overlay of the right size is reused.
  void DrawFigures(const std::vector<Figure>& figures, const Camera& camera, Overlay& overlay);

 private:
  struct State;
  explicit Renderer(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// Returns the only renderer of this process. It is made at the first call, because compiling its shaders takes longer
/// than drawing a hundred pictures. Like every renderer it must be used by one thread at a time. A picture does not
/// depend on pictures drawn before.
Result<Renderer*> SharedRenderer();

/// Fails if the environment variable ETUDE_GL, which selects the GL library, is neither "osmesa" nor "egl".
Result<void> CheckRendererChoice();

/// Loads the drawing library now and not at the first drawing, so that the library appears among the libraries of this
/// process. Fails, with the reason, if the library cannot be loaded.
Result<void> LoadRenderer();

/// Returns the versions of OpenGL and Mesa, on which pixels depend, and the library used, such as "4.5 (Core Profile)
/// Mesa 22.3.6, by OSMesa". Without a context, returns the reason.
std::string RendererVersion();

}  // namespace etude
