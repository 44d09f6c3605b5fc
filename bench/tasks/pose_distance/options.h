#pragma once

#include "bench/keys/field_table.h"
#include "bench/tasks/pose_distance/run.h"

namespace etude {

/// What a scenario of task pose-distance says of its worlds.
struct PairOptions {
  PairSource source = PairSource::kBlindSpots;
  int pairs_per_world = 500;  ///< of frames
};

const FieldTable<PairOptions>& PoseDistanceConditionFields();

/// Of methods such as
///
///     - {name: fuzzy, distance: fuzzy, weights: adaptive, threshold: 0.4}
///     - {name: joints, distance: joint-positions}
const FieldTable<PoseDistanceMethod>& PoseDistanceMethodFields();

}  // namespace etude
