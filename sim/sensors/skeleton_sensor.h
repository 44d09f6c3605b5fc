#pragma once

#include "engine/cameras/camera.h"
#include "engine/motion/body.h"
#include "engine/recognition/skeleton_stream.h"
#include "sim/random/stream.h"

namespace etude {

/// The size of a joint's errors, metres.
struct JointErrorSizes {
  double still = 0;   ///< standing still, deviation per axis of the slow wander
  double white = 0;   ///< the same of the part without memory
  double moving = 0;  ///< root mean square distance from the truth in a dance
};

/// The errors of a Kinect-like skeleton sensor. Defaults lie inside the figures measured on Kinect
/// v1/v2 recordings (algorithms A7; `tests/sim/sensors` holds the simulator to them); what no figure
/// exists for is marked (ours).
struct SkeletonSensorOptions {
  /// Times every size and every chance below (chances stop at 1); occlusion itself, its offsets and
  /// what falls out of view stay as they are. 0: hidden joints are inferred correctly, all else is true.
  double strength = 1.0;

  JointErrorSizes torso = {.still = 0.0014, .white = 0.0002, .moving = 0.025};   ///< spine, head, shoulders, hips
  JointErrorSizes middle = {.still = 0.0020, .white = 0.0006, .moving = 0.038};  ///< elbows and knees (ours)
  JointErrorSizes ends = {.still = 0.0030, .white = 0.0010, .moving = 0.052};    ///< wrists, hands, ankles, feet
  double correlation_time_s = 0.4;  ///< of the slow wander; measured 0.3–0.5
  /// Neighbouring joints err alike over this distance, metres (ours: it sets how much bones stretch,
  /// and gives the 4–12 % of v1).
  double correlation_length_m = 0.25;

  // Occlusion: an episode lasts this many frames, or until the limb is seen again, then the guess changes.
  int shortest_episode = 3;
  int longest_episode = 40;
  double nearest_guess_m = 0.2;  ///< how far a hidden hand or foot is off
  double farthest_guess_m = 1.1;
  double wrong_guess_chance = 0.6;  ///< else the guess is as good as if seen (ours)

  double dropout_share = 0.02;    ///< of all frames: the whole body is lost
  double swaps_per_minute = 1.0;  ///< arms or legs, left for right, a third of a second long (ours)
  double outlier_chance = 0.001;  ///< per joint and frame (ours; Gaussian + uniform: arXiv 1512.04134)
  double outlier_size_m = 0.15;   ///< uniform in a cube of this half side (ours)
};

/// A Kinect's depth camera (v1: 57° × 43°) at `distance` metres in front of a performer who stands at the
/// origin facing +Z, 1 m above the floor; the performer is seen turned by `turn` radians.
Camera SkeletonSensorAt(double distance, double turn);

/// What `sensor` would report of a body moving as `truth`: one frame per frame. A joint is inferred
/// while flesh stands before it, not tracked while out of view. Every error has dice of its own, and
/// as many throws per frame whatever happens, so that options change strengths and nothing else.
SkeletonStream SenseSkeleton(const BodyMotion& truth, const Camera& sensor, const SkeletonSensorOptions& options,
                             const WorldKey& world);

}  // namespace etude
