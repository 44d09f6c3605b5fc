#pragma once

#include "bench/keys/field_table.h"
#include "bench/tasks/pose_distance/run.h"

namespace etude {

/// A condition of task pose-distance.
struct PairOptions {
  PairSource source = PairSource::kBlindSpots;
  int pairs_per_world = 500;  ///< number of pairs of frames
};

const FieldTable<PairOptions>& PoseDistanceConditionFields();

/// Returns the keys of a method, for example:
///
///     - {name: fuzzy, distance: fuzzy, weights: adaptive, threshold: 0.4}
///     - {name: joints, distance: joint-positions}
const FieldTable<PoseDistanceMethod>& PoseDistanceMethodFields();

}  // namespace etude
