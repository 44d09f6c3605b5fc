#pragma once

#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/displacements.h"
#include "engine/motion/motion_faults.h"

namespace etude {

/// Appends limbs that change their lengths, knees that bend backwards and arms that pass through the trunk
/// (FindMotionFaults states the rules). Frames near `pops` do not count as changes of length. Sentences are left
/// empty.
void FindLimbFaults(const BodyMotion& motion, const FaultOptions& options, const std::vector<Pop>& pops,
                    std::vector<MotionFault>& faults);

}  // namespace etude
