#pragma once

#include <array>
#include <glm/glm.hpp>

#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// The memory of SeeClap between two frames.
struct ClapState {
  int since_apart = kLongAgo;  ///< frames since the hands were last apart
  int together = 0;            ///< frames in a row for which they have been together
  static constexpr int kLongAgo = 1000;
};

/// Takes one frame, and returns true in the one in which a clap is seen: both hands, in sight and above the hips, have
/// met within half a second of being apart. At 30 Hz.
bool SeeClap(const SensedFrame& frame, ClapState& state);

/// The memory of SeeMotion between two frames.
struct StillnessState {
  std::array<glm::dvec3, kRoleCount> rest{};  ///< where each joint has been of late
  bool started = false;
  int seen = 0;    ///< frames with a body since the count began
  int moving = 0;  ///< of them in motion
  int frames = 0;  ///< all
};

/// Takes one frame of 30 Hz, and returns true when the body is seen and moves.
bool SeeMotion(const SensedFrame& frame, StillnessState& state);
/// Restarts the counts and keeps where the joints rest.
void ResetCounts(StillnessState& state);

}  // namespace etude
