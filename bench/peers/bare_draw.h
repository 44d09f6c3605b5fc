#pragma once

#include <memory>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "sim/render/scene.h"

namespace etude {

/// A baseline for the drawing times of sim/render. It draws the same capsules and shadows with the same shaders into
/// one framebuffer (colour and labels) and reads the framebuffer back. It stores only the picture of the empty room,
/// and does no tiling or culling.
class BareDraw {
 public:
  static Result<std::unique_ptr<BareDraw>> Create(const Room& room, const Camera& camera);
  ~BareDraw();

  void Draw(const std::vector<Figure>& figures);

 private:
  struct State;
  explicit BareDraw(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace etude
