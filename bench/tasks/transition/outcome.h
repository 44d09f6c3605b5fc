#pragma once

#include "bench/metrics/transition_join.h"
#include "engine/transitions/joins/splice.h"
#include "engine/transitions/library/transition_points.h"
#include "engine/transitions/transition_record.h"

namespace etude {

struct Stage;
struct TransitionAnswer;

/// The transition of one method in one world.
struct TransitionOutcome {
  TransitionRequest request;
  bool matched = false;  ///< it chose the frames left and entered because they are alike
  MatchRules rules;      ///< those that its distances go by
  TransitionRecord record;
  Splice splice;  ///< empty when the record found no way
};

/// Does what a method outside answered, which must have a way: the clips spliced, or its own frames put between them.
/// The distances are by the fixed weights, whatever the method went by.
TransitionOutcome FollowAnswer(const TransitionAnswer& answer, const Stage& stage, const TransitionRequest& request);

/// The join of an outcome that has a way, as it is measured: beside the clip that played and the one asked for. A view
/// of both arguments.
JoinView ViewOf(const TransitionOutcome& outcome, const Stage& stage);

/// The frames of a splice from so long before its first transition point to so long after its last, as far as the
/// motion goes.
FrameWindow AroundPoints(const Splice& splice, double seconds);

/// The largest distance at a transition point of a record that has segments.
const FuzzyDistance& WorstDistance(const TransitionRecord& record);

}  // namespace etude
