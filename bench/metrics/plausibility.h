#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/motion_faults.h"

namespace etude {

/// Returns the share of a motion's time, from its first frame to its last, in which it shows a fault of this kind.
/// Faults that overlap count once. `duration_s` must be positive.
double FaultyShare(std::span<const MotionFault> faults, FaultKind kind, double duration_s);
/// Returns the largest size of the faults of this kind, in its unit; 0 if there are none.
double LargestFault(std::span<const MotionFault> faults, FaultKind kind);
/// Returns how many faults of this kind there are.
double FaultCount(std::span<const MotionFault> faults, FaultKind kind);

/// Returns the metrics, by id, whose values exceed their limits.
std::vector<std::string> BeyondLimits(const std::map<std::string, double>& values,
                                      const std::map<std::string, double>& limits);

}  // namespace etude
