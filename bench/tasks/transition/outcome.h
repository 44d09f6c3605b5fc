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
  bool matched = false;  ///< true: the two frames of the transition point were chosen because they are similar
  MatchRules rules;      ///< the rules by which the distances were computed
  TransitionRecord record;
  Splice splice;  ///< the spliced motion; empty if the record has no segments
};

/// Carries out an outside method's answer, which must have segments: splices the clips, or inserts the method's own
/// frames. Distances are computed with the weights of `stage.fuzzy`, whatever weights the method used.
TransitionOutcome FollowAnswer(const TransitionAnswer& answer, const Stage& stage, const TransitionRequest& request);

/// Returns the join of an outcome for measurement, together with the clip that played and the requested clip. The
/// outcome must have segments. The result refers to the data of both arguments.
JoinView ViewOf(const TransitionOutcome& outcome, const Stage& stage);

/// Returns the frames of a splice from `seconds` before its first transition point to `seconds` after its last. The
/// frames are clipped to the motion.
FrameWindow AroundPoints(const Splice& splice, double seconds);

/// Returns the largest distance at a transition point. The record must have segments.
const FuzzyDistance& WorstDistance(const TransitionRecord& record);

}  // namespace etude
