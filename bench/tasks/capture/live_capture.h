#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bench/tasks/capture/silhouettes.h"
#include "bench/tasks/capture/stages.h"
#include "bench/tasks/capture/take_cameras.h"
#include "engine/capture/recover_frames.h"

namespace etude {

/// A causal method and its cameras at work while somebody moves, for tasks that answer back: frame by frame what
/// `RunCapture` gives of the whole take.
class LiveCapture {
 public:
  /// `key` must outlive this; `method.causal`. Fails, saying why, when there is no renderer, the cameras cannot be
  /// calibrated, or no body can be made.
  static Result<std::unique_ptr<LiveCapture>> Begin(const StudioOptions& options, const CaptureMethod& method,
                                                    const Booking& booking, const WorldKey& key);
  LiveCapture(const LiveCapture&) = delete;
  LiveCapture& operator=(const LiveCapture&) = delete;

  /// The next pose of who moves. Cameras look between frames, too: a frame wants the two poses after it, and as many as
  /// their clocks are off.
  void Add(const BodyPose& pose) { stages_.Add(pose); }

  /// The skeleton of the next frame, whose pose is known; between pictures the last one.
  std::optional<RecoveredFrame> Next();

 private:
  LiveCapture(const StudioOptions& options, const CaptureMethod& method, const Booking& booking, const WorldKey& key);
  Result<void> Prepare();
  std::optional<RecoveredFrame> Recover(std::size_t frame);
  std::optional<RecoveredFrame> RecoverByMarks(std::size_t frame, const std::vector<TakeCameras::Picture>& pictures);

  const StudioOptions options_;
  const CaptureMethod method_;
  const WorldKey key_;
  const std::vector<PersonSource> sources_;
  CaptureStages stages_;
  const CalibratedCameras* cameras_ = nullptr;  ///< of `stages_`, as are the next two
  const CaptureBody* body_ = nullptr;
  Renderer* renderer_ = nullptr;
  std::optional<TakeCameras> take_;
  std::vector<TakeCameras::Feed> feeds_;
  std::optional<LiveRecovery> marks_;
  std::optional<LiveSilhouettes> silhouettes_;
  std::size_t frame_ = 0;  ///< the next one
  std::optional<RecoveredFrame> latest_;
};

}  // namespace etude
