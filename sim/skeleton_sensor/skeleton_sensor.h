#pragma once

#include <optional>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "engine/recognition/skeleton_stream.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/episodes.h"
#include "sim/skeleton_sensor/joint_errors.h"
#include "sim/skeleton_sensor/live_sensor.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {

/// The place of a sensor in front of a performer who is at the origin facing +Z.
struct SensorPlace {
  double distance = 2.75;  ///< metres on the floor
  double turn = 0;         ///< radians: the performer is seen turned by so much
  double height = 1.0;     ///< metres above the floor; it looks at the performer a metre above the floor
};
Camera SkeletonSensorAt(const SensorPlace& place, const Intrinsics& view);

/// A skeleton sensor, frame by frame. How much a joint errs depends on how it is about to move, so a frame's report
/// comes when the body's pose `kAhead` frames later is known: whoever closes a loop over it lets the body plan so far
/// ahead. Every error has dice of its own, and as many throws per frame whatever happens, so that options change
/// strengths and nothing else.
class SkeletonSensor final : public LiveSensor {
 public:
  /// `occluders` must outlive this; `rate_hz` > 0.
  SkeletonSensor(const Camera& sensor, const Occluders& occluders, const SkeletonSensorOptions& options, double rate_hz,
                 const WorldKey& world);

  /// Reports a joint as inferred while something stands before it, and as not tracked while it is out of view; a report
  /// is of the pose the options' lag ago.
  std::optional<SensedFrame> Update(const BodyPose& pose) override;
  /// Returns the reports of the last `kAhead` frames at the end of a motion. Nothing may follow.
  std::vector<SensedFrame> Finish();

 private:
  SensedFrame Sense(const BodyPose& pose, const FrameMotion& motion);
  SensedFrame Delayed(const SensedFrame& sensed);

  Camera sensor_;
  ProjectionMatrix view_;
  const Occluders& occluders_;
  MotionWindow motion_;
  ContinuousErrors errors_;
  OcclusionGuesses guesses_;
  Outliers outliers_;
  Swaps swaps_;
  Dropouts dropouts_;
  std::size_t frame_ = 0;             ///< sensed so far
  SensedFrame last_;                  ///< before arms or legs were exchanged
  std::vector<SensedFrame> delayed_;  ///< a ring of the last Lag() + 1 frames
};

/// Returns what `sensor` would report of a body that moves as `truth`, frame by frame.
SkeletonStream SenseSkeleton(const BodyMotion& truth, const Camera& sensor, const Occluders& occluders,
                             const SkeletonSensorOptions& options, const WorldKey& world);

}  // namespace etude
