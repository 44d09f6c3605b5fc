#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/motion/body.h"
#include "sim/skeleton_sensor/joint_errors.h"
#include "sim/skeleton_sensor/visibility.h"

namespace etude {

/// What the sensor makes of a joint that is not plainly seen.
struct Guess {
  bool inferred = false;
  glm::dvec3 offset{0};  ///< metres from where it would be reported if it were seen
};
using FrameGuesses = std::array<Guess, kRoleCount>;

/// The guesses for hidden joints, limb by limb, in episodes.
std::vector<FrameGuesses> OcclusionGuesses(const BodyMotion& truth, const std::vector<HiddenJoints>& hidden,
                                           const SkeletonSensorOptions& options, const WorldKey& world);

/// Rare single-frame errors of single joints, zero where there is none.
JointErrors Outliers(std::size_t frames, const SkeletonSensorOptions& options, const WorldKey& world);

/// Which frames show arms, or legs, exchanged.
struct Swap {
  bool arms = false;
  bool legs = false;
};
/// `turns`: per frame, how far the body is turned away from the sensor, radians.
std::vector<Swap> Swaps(const std::vector<double>& turns, double rate_hz, const SkeletonSensorOptions& options,
                        const WorldKey& world);

/// Which frames the whole body is lost in.
std::vector<bool> Dropouts(std::size_t frames, const SkeletonSensorOptions& options, const WorldKey& world);

}  // namespace etude
