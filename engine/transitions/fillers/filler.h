#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/settings.h"
#include "engine/motion/tree_motion.h"

namespace etude {

class GapLibrary;

/// The frames around a gap, and how many are missing.
struct Gap {
  const JointTree& tree;
  std::span<const TreePose> past;    ///< at least two; the last is the frame before the gap
  std::span<const TreePose> future;  ///< at least one; the first is the frame after the gap
  std::size_t frames = 0;            ///< missing ones, at least one
  double rate_hz = 30;
  const GapLibrary* library = nullptr;  ///< for fillers that need one

  double Seconds() const { return static_cast<double>(frames + 1) / rate_hz; }
};

/// A way of filling gaps, with the name that scenario files use.
struct Filler {
  std::string name;
  std::string description;  ///< one line for users
  std::vector<NumberSetting> settings = {};
  bool needs_library = false;
  /// Returns the missing frames; none if a library holds no gap of that length on this tree. `values` holds one value
  /// per setting, in order; empty means the defaults.
  std::vector<TreePose> (*fill)(const Gap& gap, std::span<const double> values) = nullptr;
};

/// Returns all fillers, the field's first baseline first.
std::span<const Filler> AllFillers();

/// A channel across a gap: a position in metres or a rotation vector in radians; velocities are per second.
struct Ends {
  glm::dvec3 start{0}, start_velocity{0}, end{0};
  std::optional<glm::dvec3> end_velocity = {};  ///< unknown with one future frame
  double seconds = 1;                           ///< from start to end
};

/// Returns the interpolation plus, at either end, the rest of what the end's velocity differs from it: a critically
/// damped spring (SpringDecay), faded out with 3t² − 2t³ so that it is gone at the other end.
glm::dvec3 InertialisedAt(const Ends& ends, double seconds, double half_life_s);

/// Returns the start, continued, faded by 3t² − 2t³ into the end, continued backwards. Both continue with a velocity
/// that halves every `half_life_s` (Holden 2023, "Dead Blending"). An unknown velocity is the mean one across the gap.
glm::dvec3 DeadBlendedAt(const Ends& ends, double seconds, double half_life_s);

/// Returns the movement of minimum jerk from rest acceleration (Flash and Hogan 1985). With an unknown end velocity,
/// velocity and acceleration at the end are those of the least jerk.
glm::dvec3 LeastJerkAt(const Ends& ends, double seconds);

}  // namespace etude
