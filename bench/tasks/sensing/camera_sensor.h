#pragma once

#include <memory>

#include "bench/tasks/capture/live_capture.h"
#include "engine/base/result.h"
#include "sim/skeleton_sensor/live_sensor.h"

namespace etude {

/// Cameras as the sensor of a loop: a causal way of capturing who moves, frame by frame. It computes in no time.
class CameraSensor final : public LiveSensor {
 public:
  /// Set up for somebody who stands as in `first`, for so many frames. `key` must outlive this; `method.causal`. Fails,
  /// saying why, as `LiveCapture` does.
  static Result<std::unique_ptr<LiveSensor>> Make(const StudioOptions& studio, const CaptureMethod& method,
                                                  const BodyPose& first, std::size_t frames, const WorldKey& key);

  std::optional<SensedFrame> Update(const BodyPose& pose) override;

 private:
  explicit CameraSensor(std::unique_ptr<LiveCapture> capture) : capture_(std::move(capture)) {}

  const std::unique_ptr<LiveCapture> capture_;
  std::size_t poses_ = 0;
  SensedFrame last_;
};

}  // namespace etude
