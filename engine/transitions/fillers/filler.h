#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/settings.h"
#include "engine/motion/tree_motion.h"

namespace etude {

class GapLibrary;

/// A gap in a motion: the frames around it, and the number of missing frames.
struct Gap {
  const JointTree& tree;
  std::span<const TreePose> past;    ///< at least two; the last is the frame before the gap
  std::span<const TreePose> future;  ///< at least one; the first is the frame after the gap
  std::size_t frames = 0;            ///< number of missing frames, at least one
  double rate_hz = 30;
  const GapLibrary* library = nullptr;                       ///< for fillers that need a library
  std::array<int, kRoleCount> roles = RawMotion::NoRoles();  ///< the joint of each role; −1 if the tree has none

  /// Returns the time from the last past frame to the first future frame.
  double Seconds() const { return static_cast<double>(frames + 1) / rate_hz; }
};

/// A method that fills gaps. Scenario files use its name.
struct Filler {
  std::string name;
  std::string description;  ///< one line for users
  std::vector<NumberSetting> settings = {};
  bool uses_library = false;
  /// Returns the missing frames. Returns no frames if the filler needs a library and the library has no gap of this
  /// length on this tree. `values` has one value per setting, in order; if empty, the defaults apply.
  std::vector<TreePose> (*fill)(const Gap& gap, std::span<const double> values) = nullptr;
};

/// Returns all fillers, the field's baselines first.
std::span<const Filler> AllFillers();

/// The start and end of one channel of a gap: a position in metres or a rotation vector in radians; velocities are per
/// second. The functions below return the channel's value `seconds` after the start.
struct Ends {
  glm::dvec3 start{0}, start_velocity{0}, end{0};
  std::optional<glm::dvec3> end_velocity = {};  ///< nullopt if there is only one future frame
  double seconds = 1;                           ///< from start to end
};

/// Returns the straight line from start to end plus one offset for each end. An offset starts with the value 0; its
/// initial velocity is the difference between the velocity at this end and the mean velocity. It decays as a critically
/// damped spring (SpringDecay), and fades to 0 at the other end by 3s² − 2s³, where s is the elapsed share of the gap.
/// The end has no offset if its velocity is absent.
glm::dvec3 InertialisedAt(const Ends& ends, double seconds, double half_life_s);

/// Continues the motion forwards from the start and backwards from the end, each time with a velocity that halves every
/// `half_life_s`. Fades from the forward to the backward continuation by 3s² − 2s³, where s is the elapsed share of the
/// gap (Holden 2023, "Dead Blending"). An absent end velocity is replaced by the mean velocity across the gap.
glm::dvec3 DeadBlendedAt(const Ends& ends, double seconds, double half_life_s);

/// Returns the movement of minimum jerk with acceleration 0 at both ends (Flash and Hogan 1985). If the end velocity is
/// absent, velocity and acceleration at the end are free.
glm::dvec3 LeastJerkAt(const Ends& ends, double seconds);

}  // namespace etude
