#pragma once

#include <span>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/pose_distance/run.h"

namespace etude {

/// What a scenario of task pose-distance says of its worlds.
struct PairOptions {
  PairSource source = PairSource::kBlindSpots;
  int pairs_per_world = 500;  ///< of frames
};

PairOptions ReadPairOptions(Fields& condition);
std::vector<KeyInfo> PoseDistanceConditionKeys();

/// Reads methods such as
///
///     - {name: fuzzy, distance: fuzzy, weights: adaptive, threshold: 0.4}
///     - {name: joints, distance: joint-positions, threshold_cm: 8}
Result<std::vector<PoseDistanceMethod>> ReadPoseDistanceMethods(std::span<const Node> methods);
std::vector<KeyInfo> PoseDistanceMethodKeys();

}  // namespace etude
