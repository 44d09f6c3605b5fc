#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "engine/motion/body.h"
#include "sim/sensors/skeleton_sensor.h"

namespace etude {

/// Which joints of one frame are hidden behind flesh.
using HiddenJoints = std::array<bool, kRoleCount>;

/// What the sensor makes of a joint that is not plainly seen.
struct Guess {
  bool inferred = false;
  glm::dvec3 offset{0};  ///< metres from where it would be reported if it were seen
};
using FrameGuesses = std::array<Guess, kRoleCount>;

/// The sum of both continuous errors, per frame and joint: the wander that never stops
/// (Ornstein–Uhlenbeck and white), and the error that depends on place and speed.
std::vector<std::array<glm::dvec3, kRoleCount>> ContinuousErrors(const BodyMotion& truth,
                                                                 const SkeletonSensorOptions& options,
                                                                 const WorldKey& world);

/// The guesses for hidden joints, limb by limb, in episodes.
std::vector<FrameGuesses> OcclusionGuesses(const BodyMotion& truth, const std::vector<HiddenJoints>& hidden,
                                           const SkeletonSensorOptions& options, const WorldKey& world);

/// Rare single-frame errors of single joints, zero where there is none.
std::vector<std::array<glm::dvec3, kRoleCount>> Outliers(std::size_t frames, const SkeletonSensorOptions& options,
                                                         const WorldKey& world);

/// Which frames show arms, or legs, exchanged.
struct Swap {
  bool arms = false;
  bool legs = false;
};
std::vector<Swap> Swaps(std::size_t frames, double rate_hz, const SkeletonSensorOptions& options,
                        const WorldKey& world);

/// Which frames the whole body is lost in.
std::vector<bool> Dropouts(std::size_t frames, const SkeletonSensorOptions& options, const WorldKey& world);

}  // namespace etude
