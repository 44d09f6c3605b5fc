#pragma once

#include <array>
#include <glm/glm.hpp>

#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// What is remembered between frames to see whether somebody moves.
struct StillnessState {
  std::array<glm::dvec3, kRoleCount> rest{};  ///< where each joint has been of late
  bool started = false;
  int seen = 0;    ///< frames with a body since the count began
  int moving = 0;  ///< of them in motion
  int frames = 0;  ///< all
};

/// Takes one frame in; true when the body is seen and moves. At 30 Hz.
bool SeeMotion(const SensedFrame& frame, StillnessState& state);
/// Counts from here on; where joints rest stays known.
void CountAnew(StillnessState& state);

}  // namespace etude
