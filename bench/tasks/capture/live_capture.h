#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "bench/tasks/capture/silhouettes.h"
#include "bench/tasks/capture/stages.h"
#include "bench/tasks/capture/take_cameras.h"
#include "engine/capture/recover_frames.h"

namespace etude {

/// Runs a causal method and its cameras while a person moves, for tasks with a feedback loop. Each frame equals the
/// frame that `RunCapture` would return for the whole take.
class LiveCapture {
 public:
  /// Sets up the cameras. `method.causal` must be set. `key` must outlive this object. Fails if there is no renderer,
  /// the cameras cannot be calibrated, or no body can be made.
  static Result<std::unique_ptr<LiveCapture>> Begin(const StudioOptions& options, const CaptureMethod& method,
                                                    const FilmedPerson& booking, const WorldKey& key);
  LiveCapture(const LiveCapture&) = delete;
  LiveCapture& operator=(const LiveCapture&) = delete;

  /// Adds the person's next pose. Cameras also shoot between frames, so a frame needs the two poses after it, and more
  /// if the cameras' clocks differ.
  void Add(const BodyPose& pose) { stages_.Add(pose); }

  /// Returns the skeleton of the next frame. The pose of that frame, and the later poses that the frame needs (Add),
  /// must have been added. Between pictures, the last skeleton is returned again.
  std::optional<RecoveredFrame> Next();

 private:
  LiveCapture(const StudioOptions& options, const CaptureMethod& method, const FilmedPerson& booking, const WorldKey& key);
  Result<void> Prepare();
  std::optional<RecoveredFrame> Recover(std::size_t frame);
  std::optional<RecoveredFrame> RecoverByMarks(std::size_t frame, const std::vector<TakeCameras::Picture>& pictures);

  const StudioOptions options_;
  const CaptureMethod method_;
  const WorldKey key_;
  const std::vector<PersonSource> sources_;
  CaptureStages stages_;
  const CalibratedCameras* cameras_ = nullptr;  ///< `stages_` owns the objects of this and the next two pointers
  const CaptureBody* body_ = nullptr;
  Renderer* renderer_ = nullptr;
  std::optional<TakeCameras> take_;
  std::vector<TakeCameras::Feed> feeds_;
  std::optional<LiveRecovery> marks_;
  std::optional<LiveSilhouettes> silhouettes_;
  std::size_t frame_ = 0;  ///< the frame whose skeleton the next call of Next() returns
  std::optional<RecoveredFrame> latest_;
};

}  // namespace etude
