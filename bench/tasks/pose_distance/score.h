#pragma once

#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/pose_distance/run.h"

namespace etude {

/// The ids of all metrics, in the order in which they are measured.
std::vector<std::string> PoseDistanceMetrics();

/// Measures a verdict. `distance` is the built-in one that was asked, whose own number a pair has; null for a method
/// outside, whose scale nobody knows.
CellResult ScorePairs(const PairWorld& world, const PairVerdict& verdict, const PoseDistance* distance);

}  // namespace etude
