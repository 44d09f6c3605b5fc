#pragma once

#include <array>
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
  std::size_t frames = 0;            ///< how many are missing, at least one
  double rate_hz = 30;
  const GapLibrary* library = nullptr;                       ///< for fillers that use one
  std::array<int, kRoleCount> roles = RawMotion::NoRoles();  ///< the joint of each role; −1: none

  /// Returns the time from the last past frame to the first future frame.
  double Seconds() const { return static_cast<double>(frames + 1) / rate_hz; }
};

/// A way of filling gaps, with the name that scenario files use.
struct Filler {
  std::string name;
  std::string description;  ///< one line for users
  std::vector<NumberSetting> settings = {};
  bool uses_library = false;
  /// Returns the missing frames, or nothing if the filler needs a library and finds no gap of that length on this tree.
  /// `values` holds one value per setting, in order; empty means the defaults.
  std::vector<TreePose> (*fill)(const Gap& gap, std::span<const double> values) = nullptr;
};

/// Returns all fillers, the field's baselines first.
std::span<const Filler> AllFillers();

/// The ends of one channel of a gap: a position in metres or a rotation vector in radians; velocities are per second.
/// The functions below return the channel `seconds` after the start.
struct Ends {
  glm::dvec3 start{0}, start_velocity{0}, end{0};
  std::optional<glm::dvec3> end_velocity = {};  ///< unknown with one future frame
  double seconds = 1;                           ///< from start to end
};

/// Returns the straight line from start to end plus an offset for either end. The offset begins with the difference of
/// that end's velocity from the mean velocity, decays as a critically damped spring (SpringDecay), and fades by 3s² −
/// 2s³, s the share of the gap, to 0 at the other end. An unknown end velocity has no offset.
glm::dvec3 InertialisedAt(const Ends& ends, double seconds, double half_life_s);

/// Continues the start forwards and the end backwards, each with a velocity that halves every `half_life_s`, and fades
/// from the one to the other by 3s² − 2s³, s the share of the gap (Holden 2023, "Dead Blending"). An unknown end
/// velocity is taken as the mean velocity across the gap.
glm::dvec3 DeadBlendedAt(const Ends& ends, double seconds, double half_life_s);

/// Returns the movement of minimum jerk with acceleration 0 at both ends (Flash and Hogan 1985). If the end velocity is
/// unknown, velocity and acceleration at the end are free.
glm::dvec3 LeastJerkAt(const Ends& ends, double seconds);

}  // namespace etude
