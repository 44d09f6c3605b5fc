#pragma once

#include <vector>

#include "engine/motion/ground_view.h"
#include "engine/motion/motion_faults.h"

namespace etude {

// Each function below appends the faults of some kinds, by the rules of FindMotionFaults, and leaves their sentences
// empty.

/// Appends jumps, floats and sinks.
void FindLevelFaults(const GroundView& ground, std::vector<MotionFault>& faults);
/// Appends skates: of the whole body, and of one foot alone. `unseen`: see FaultOptions::unseen.
void FindSkates(const GroundView& ground, std::span<const JointSet> unseen, std::vector<MotionFault>& faults);
/// Appends one fault if flights show an acceleration that is not gravity's.
void FindFalls(const GroundView& ground, std::vector<MotionFault>& faults);

}  // namespace etude
