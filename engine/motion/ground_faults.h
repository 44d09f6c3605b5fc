#pragma once

#include <vector>

#include "engine/motion/ground_view.h"
#include "engine/motion/motion_faults.h"

namespace etude {

// Each function appends the faults of its kinds, by the rules of FindMotionFaults. Sentences are left empty.

/// Appends jumps, floats and sinks.
void FindLevelFaults(const GroundView& ground, std::vector<MotionFault>& faults);
/// Appends skates, of both feet and of one. `unseen`: FaultOptions::unseen.
void FindSkates(const GroundView& ground, std::span<const JointSet> unseen, std::vector<MotionFault>& faults);
/// Appends the flight that shows another gravity, if there is one.
void FindFalls(const GroundView& ground, std::vector<MotionFault>& faults);

}  // namespace etude
