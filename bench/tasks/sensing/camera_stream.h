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

/// Describes a person for whom the studio's cameras are set up. The person stands as in `first`, may move up to half a
/// metre to every side, and may raise an arm above the head. The limb lengths are those of `first`. `places` are the
/// expected poses (PlacesAround).
FilmedPerson MakeFilmedPerson(std::span<const BodyPose> places, const BodyPose& first, std::size_t frames);
std::vector<BodyPose> PlacesAround(const BodyPose& first);

/// Returns the sensor frame that cameras report: every joint is tracked, at its position in the skeleton. If there is
/// no skeleton, the frame shows no body, and all joints keep their positions in `last`.
SensedFrame SensedOf(const std::optional<RecoveredFrame>& recovered, const SensedFrame& last);

/// Cameras that film a motion that is known beforehand. All capture methods work on the same pictures.
class CameraTake {
 public:
  /// `sensing` must outlive this object. The rate of the motion must be 30 Hz.
  CameraTake(const CameraSensing& sensing, const BodyMotion& motion, const WorldKey& key);

  /// Takes the pictures, which all methods share. Without this call, the first method takes the pictures, and the time
  /// counts as that method's own.
  void Film() { (void)stages_.GetTake(); }  // a failure is ignored here, because every method reports it

  /// Returns the stream of the whole motion. Fails, with the reason, if there is no renderer, the cameras cannot be
  /// calibrated, or no body can be made.
  const Result<SkeletonStream>& See(const CaptureMethod& method);

 private:
  CaptureStages stages_;
  std::deque<std::pair<CaptureMethod, Result<SkeletonStream>>> seen_;
};

/// Cameras as the sensor of a feedback loop. A causal method captures the person frame by frame. The method's computing
/// time is not simulated.
class CameraSensor final : public LiveSensor {
 public:
  /// Sets up the cameras for a person who stands as in `first`, for `frames` frames. `key` must outlive this object.
  /// `method.causal` must be set. Fails if LiveCapture::Begin fails.
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
