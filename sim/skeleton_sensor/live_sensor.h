#pragma once

#include <cstddef>
#include <optional>

#include "engine/motion/body.h"
#include "engine/recognition/skeleton_stream.h"
#include "sim/skeleton_sensor/motion_window.h"

namespace etude {

/// What watches a body while it moves, whatever it sees by: a loop is closed over this.
class LiveSensor {
 public:
  /// How many frames ahead a body must have planned: sensors err by how it is about to move, cameras look between
  /// frames. What is reported of a frame depends on later pictures or reports in no case.
  static constexpr std::size_t kAhead = MotionWindow::kAhead;

  virtual ~LiveSensor() = default;

  /// Takes the body's next pose, and tells what is reported in the frame `kAhead` before it; nothing in the first
  /// `kAhead` frames.
  virtual std::optional<SensedFrame> Update(const BodyPose& pose) = 0;
};

}  // namespace etude
