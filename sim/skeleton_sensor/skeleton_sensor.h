#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "engine/recognition/skeleton_stream.h"
#include "sim/body/shape.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/joint_errors.h"
#include "sim/skeleton_sensor/live_sensor.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {

/// Flags that say for each joint of one frame whether it is hidden.
using HiddenJoints = std::array<bool, kRoleCount>;

/// The things beside the body itself that may stand between it and a sensor.
struct Occluders {
  std::vector<Cuboid> furniture;
  std::vector<BodyPose> bystander;  ///< a second person: a pose per frame (the last one stays), none = nobody
};

/// Finds the joints of `pose` in this frame that `eye` does not see: the ray to the joint meets another part of the
/// body, furniture or the second person clearly (2 cm) before the joint's own skin. The flesh is what the renderer
/// draws (sim/body).
HiddenJoints FindHidden(const BodyPose& pose, std::size_t frame, const Occluders& occluders, const glm::dvec3& eye);

/// The sensor's guess of a joint that is not plainly seen.
struct Guess {
  bool inferred = false;
  glm::dvec3 offset{0};  ///< metres from where it would be reported if it were seen
};
using FrameGuesses = std::array<Guess, kRoleCount>;

/// The guesses for hidden joints, limb by limb, in episodes.
class OcclusionGuesses {
 public:
  OcclusionGuesses(const SkeletonSensorOptions& options, const WorldKey& world);
  FrameGuesses Next(const BodyPose& pose, const HiddenJoints& hidden);

 private:
  static constexpr std::size_t kLimbs = 4, kJointsOfLimb = 4;
  /// The current guess of where the hidden joints of one limb are, wrong or right by luck.
  struct Episode {
    int age = 0;
    int length = 0;  ///< 0: none running
    bool wrong = false;
    double size_m = 0;
    glm::dvec3 direction{0};
    std::array<bool, kJointsOfLimb> joints{};  ///< which were hidden since it began

    bool IsRunning() const { return length > 0; }
  };

  Episode Throw();

  SkeletonSensorOptions options_;
  RandomStream dice_;
  std::array<Episode, kLimbs> episodes_;
};

/// Rare single-frame errors of single joints, zero where there is none.
class Outliers {
 public:
  Outliers(const SkeletonSensorOptions& options, const WorldKey& world);
  FrameErrors Next();

 private:
  double chance_, size_m_;
  RandomStream dice_;
};

/// Flags that say whether a frame shows arms, or legs, exchanged.
struct Swap {
  bool arms = false;
  bool legs = false;
};
class Swaps {
 public:
  Swaps(double rate_hz, const SkeletonSensorOptions& options, const WorldKey& world);
  /// Returns the next frame's swap. `turn` is how far the body is turned away from the sensor in it, radians.
  Swap Next(double turn);

 private:
  double usual_chance_;  ///< of starting in a frame
  bool when_facing_;
  int length_;  ///< frames
  RandomStream dice_;
  int left_ = 0;
  Swap current_;
};

/// The dropouts: frames in which the whole body is lost.
class Dropouts {
 public:
  Dropouts(const SkeletonSensorOptions& options, const WorldKey& world);
  bool Next();

 private:
  double chance_;  ///< of starting in a frame with the body seen
  RandomStream dice_;
  std::uint64_t left_ = 0;
};

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
