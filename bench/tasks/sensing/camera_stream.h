#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bench/tasks/capture/live_capture.h"
#include "bench/tasks/capture/stages.h"
#include "bench/tasks/capture/world.h"
#include "bench/tasks/sensing/options.h"
#include "engine/base/result.h"
#include "engine/capture/recover_frames.h"
#include "engine/motion/body.h"
#include "engine/recognition/skeleton_stream.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/live_sensor.h"

namespace etude {

/// The studio's cameras, set up for somebody who stands as in `first` and will dance there: half a metre to every side,
/// and as high as they jump. Their limbs are those of that pose.
Booking BookFor(std::span<const BodyPose> places, const BodyPose& first, std::size_t frames);
std::vector<BodyPose> PlacesAround(const BodyPose& first);

/// A frame that cameras tell: every joint tracked where the skeleton has it; without a skeleton nobody is seen, and all
/// joints are where they were in `last`.
SensedFrame SensedOf(const std::optional<RecoveredFrame>& recovered, const SensedFrame& last);

/// Cameras before a motion that is known beforehand: what every way of capturing it makes of the same pictures.
class CameraTake {
 public:
  /// `sensing` must outlive this. The motion has 30 Hz.
  CameraTake(const CameraSensing& sensing, const BodyMotion& motion, const WorldKey& key);

  /// Takes the pictures, which all methods share; else the first one that asks does.
  void Film() { (void)stages_.GetTake(); }  // a failure is told to every method

  /// The stream of the whole motion. Fails, saying why, when there is no
  /// renderer, the cameras cannot be calibrated, or no body can be made.
  const Result<SkeletonStream>& See(const CaptureMethod& method);

 private:
  CaptureStages stages_;
  std::deque<std::pair<CaptureMethod, Result<SkeletonStream>>> seen_;
};

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
