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

/// For each joint of one frame: true if the joint is hidden.
using HiddenJoints = std::array<bool, kRoleCount>;

/// The objects that may hide a body from a sensor, besides the body itself.
struct Occluders {
  std::vector<Cuboid> furniture;
  std::vector<BodyPose> bystander;  ///< a second person, one pose per frame; the last pose is repeated; empty: nobody
};

/// Finds the joints of `pose` that are hidden from `eye` in this frame: the ray to the joint hits another part of the
/// body, furniture or the second person at least 2 cm before the ray reaches the joint's own skin. The body has the
/// shape that the renderer draws (sim/body).
HiddenJoints FindHidden(const BodyPose& pose, std::size_t frame, const Occluders& occluders, const glm::dvec3& eye);

/// The sensor's guess of the position of a joint that is not clearly seen.
struct Guess {
  bool inferred = false;
  glm::dvec3 offset{0};  ///< offset from the position that would be reported if the joint were seen, metres
};
using FrameGuesses = std::array<Guess, kRoleCount>;

/// Simulates how the sensor guesses the positions of hidden joints. The guesses are random. Each limb has its own
/// guess, which is kept for one episode. SkeletonSensorOptions limits the length of an episode.
class OcclusionGuesses {
 public:
  OcclusionGuesses(const SkeletonSensorOptions& options, const WorldKey& world);
  /// Returns the guesses of the next frame. A joint is inferred if it is hidden now, or was hidden at some time in its
  /// limb's current episode.
  FrameGuesses Next(const BodyPose& pose, const HiddenJoints& hidden);

 private:
  static constexpr std::size_t kLimbs = 4, kJointsOfLimb = 4;
  /// The current guess for the hidden joints of one limb. The guess is right or wrong at random.
  struct Episode {
    int age = 0;
    int length = 0;  ///< length of the episode, frames; 0: no episode
    bool wrong = false;
    double size_m = 0;
    glm::dvec3 direction{0};
    std::array<bool, kJointsOfLimb> joints{};  ///< true for joints that were hidden at some time in the episode

    bool IsRunning() const { return length > 0; }
  };

  Episode DrawEpisode();

  SkeletonSensorOptions options_;
  RandomStream dice_;
  std::array<Episode, kLimbs> episodes_;
};

/// Adds rare large errors to single joints in single frames, at random. All other errors are zero.
class Outliers {
 public:
  Outliers(const SkeletonSensorOptions& options, const WorldKey& world);
  /// Returns the errors of the next frame, metres in the world.
  FrameErrors Next();

 private:
  double chance_, size_m_;
  RandomStream dice_;
};

/// The swap in one frame: true if the left and the right arm, or the left and the right leg, are exchanged.
struct Swap {
  bool arms = false;
  bool legs = false;
};
class Swaps {
 public:
  Swaps(double rate_hz, const SkeletonSensorOptions& options, const WorldKey& world);
  /// Returns the next frame's swap. `turn` is the angle by which the body is turned away from the sensor, radians.
  Swap Next(double turn);

 private:
  double usual_chance_;  ///< probability that a swap starts in a frame, for a body in profile
  bool when_facing_;
  int length_;  ///< length of a swap, frames
  RandomStream dice_;
  int left_ = 0;
  Swap current_;
};

/// Chooses the dropouts at random. In these frames, the sensor loses the whole body.
class Dropouts {
 public:
  Dropouts(const SkeletonSensorOptions& options, const WorldKey& world);
  /// Returns true if the body is lost in the next frame.
  bool Next();

 private:
  double chance_;  ///< probability that a dropout starts in a frame with the body in sight
  RandomStream dice_;
  std::uint64_t left_ = 0;
};

/// The position of a sensor relative to a performer who is at the origin and faces +Z.
struct SensorPlacement {
  double distance = 2.75;  ///< metres along the floor
  double turn = 0;         ///< radians; the performer appears turned by this angle
  double height = 1.0;     ///< metres above the floor; the sensor looks at a point one metre above the floor
};
/// Returns the sensor as a camera at the sensor's pose, with the intrinsics `view`.
Camera SkeletonSensorAt(const SensorPlacement& place, const Intrinsics& view);

/// Simulates a skeleton sensor, frame by frame. A joint's error depends on the body's motion around the frame, so a
/// frame's report is available only when the pose `kAhead` frames later is known. In a closed loop the body must plan
/// `kAhead` frames ahead. Every kind of error has its own random stream and a fixed number of random numbers per frame.
/// Options therefore change only the strengths.
class SkeletonSensor final : public LiveSensor {
 public:
  /// `occluders` must outlive this object; `rate_hz` must be positive.
  SkeletonSensor(const Camera& sensor, const Occluders& occluders, const SkeletonSensorOptions& options, double rate_hz,
                 const WorldKey& world);

  /// Reports a joint as inferred while it is hidden, and as not tracked while it is out of view. Because of the lag,
  /// the report of a frame describes the pose `options.Lag()` frames before this frame.
  std::optional<SensedFrame> Update(const BodyPose& pose) override;
  /// Returns the reports of the last `kAhead` frames, at the end of a motion. No other call may follow.
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
  std::size_t frame_ = 0;             ///< number of frames sensed so far
  SensedFrame last_;                  ///< the last frame, as it was before swaps
  std::vector<SensedFrame> delayed_;  ///< a ring of the last Lag() + 1 frames
};

/// Returns the stream that `sensor` reports of a body that moves like `truth`.
SkeletonStream SenseSkeleton(const BodyMotion& truth, const Camera& sensor, const Occluders& occluders,
                             const SkeletonSensorOptions& options, const WorldKey& world);

}  // namespace etude
