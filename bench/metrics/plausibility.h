#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/motion_faults.h"

namespace etude {

/// Returns the share of a motion's duration in which the motion shows a fault of this kind. Overlapping faults count
/// once. `duration_s` must be positive.
double FaultyShare(std::span<const MotionFault> faults, FaultKind kind, double duration_s);
/// Returns the largest size of the faults of this kind, in the kind's unit; 0 if there are none.
double LargestFault(std::span<const MotionFault> faults, FaultKind kind);
double FaultCount(std::span<const MotionFault> faults, FaultKind kind);

/// Returns the ids of the metrics whose values exceed their limits.
std::vector<std::string> BeyondLimits(const std::map<std::string, double>& values,
                                      const std::map<std::string, double>& limits);

}  // namespace etude
