#pragma once

#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// How much what was seen counts.
enum class Weighting {
  kFixed,     ///< everything 1: A's
  kAdaptive,  ///< by how well its joints are seen (ours)
};

struct SightWeights {
  /// Fixed, because it is A's. Adaptive where a miss costs more than praise for a mistake, most of all where the body
  /// hides its own far side: what is not seen is not counted, mistakes included.
  Weighting weighting = Weighting::kFixed;
  /// What an angle with an inferred joint counts (adaptive weights), in [0, 1]; a tracked one counts 1. At 0.3 (ours)
  /// three guessed angles cannot outvote one that is seen. Raise it for a sensor whose guesses are good; at 1 adaptive
  /// weights are fixed ones for whatever is tracked or inferred.
  double inferred_weight = 0.3;
  /// What an angle with a joint that is not tracked counts (adaptive weights), in [0, 1]. Nothing, because such a joint
  /// repeats where it was last. Raise it only for a sensor that goes on reporting joints it calls not tracked.
  double not_tracked_weight = 0.0;

  double Of(TrackingState state) const {
    if (weighting == Weighting::kFixed || state == TrackingState::kTracked) return 1.0;
    return state == TrackingState::kInferred ? inferred_weight : not_tracked_weight;
  }
};

}  // namespace etude
