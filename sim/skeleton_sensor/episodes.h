#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "engine/motion/body.h"
#include "sim/body/shape.h"
#include "sim/random/stream.h"
#include "sim/skeleton_sensor/joint_errors.h"
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

}  // namespace etude
