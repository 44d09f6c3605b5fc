#pragma once

#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "engine/motion/displacements.h"
#include "engine/motion/motion_faults.h"

namespace etude {

/// Appends limbs that change their lengths, knees that bend backwards and arms that pass through the trunk
/// (FindMotionFaults states the rules). Frames near `pops` do not count as changes of length. `unseen`:
/// FaultOptions::unseen. Sentences are left empty.
void FindLimbFaults(const BodyMotion& motion, std::span<const JointSet> unseen, const std::vector<Pop>& pops,
                    std::vector<MotionFault>& faults);

}  // namespace etude
