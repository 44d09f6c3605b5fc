#pragma once

#include <memory>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "sim/render/scene.h"

namespace etude {

/// The yardstick of sim/render: the same shaders, capsules and shadows drawn into the whole of one framebuffer of
/// colour and labels, and read back, with nothing kept, cut or copied around it but the picture of the empty room.
class BareDraw {
 public:
  static Result<std::unique_ptr<BareDraw>> Create(const Room& room, const Camera& camera);
  ~BareDraw();

  /// Draws and reads back colour (RGBA) and labels, whole pictures.
  void Draw(const std::vector<Figure>& figures);

 private:
  struct State;
  explicit BareDraw(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace etude
