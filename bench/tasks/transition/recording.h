#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/transition/outcome.h"
#include "bench/tasks/transition/stage.h"

namespace etude {

/// The curve of largest second differences from one second before the first transition point to one second after
/// the last.
Series JumpSeries(const TransitionOutcome& outcome);

/// What explains a transition in numbers, for every cell that is asked to keep it: `point_partials`, ten for each
/// transition point (axis "feature"), and one value for each candidate (axis "candidate"): `candidate_point`,
/// `candidate_from_frame`, `candidate_to_frame`, `candidate_distance`, `candidate_outcome` (0 taken, 1 too far, 2
/// later, 3 worse), and its ten `candidate_partials` (axis "feature").
std::vector<Series> ExplanationOf(const TransitionRecord& record);

/// The transition, which must have a way, with 2.5 s before and after it: track "coach", and the facts that explain it.
///
///     {"transition_frame": 60, "transition_frames": [60, 75], "from": "builtin:clap", "to": …, "branch": "in-between",
///      "why": "no match among …", "request_frame": 52, "wait_s": 0.8, "threshold": 0.4, "natural_limit_cm": 3.8,
///      "distance": 0.31, "weights": {"RH": 1, …}, "partials": {"RH": 0.02, …}, "pairs_seen": 900, "pairs_matched": 0,
///      "transition_points": [{"from": …, "from_frame": 60, "to": "in-between", "to_frame": 0, "distance": …,
///                    "partials": …}, …],
///      "cost_unit": "cm",
///      "candidates": [{"point": 0, "from_frame": 60, "to_frame": 12, "distance": 0.31, "partials": {"RH": …},
///                      "cost": 8.2, "outcome": "taken"}, …]}
///
/// `transition_frames` and `request_frame` count in the recording (a negative one is before it begins), all other
/// frames in their clips. `distance` and `partials` beside them are those of the worst transition point. `point` tells
/// for which of them a candidate was looked at; `cost` is null for choices that rank by nothing.
Recording RecordTransition(const TransitionOutcome& outcome, const Stage& stage);

}  // namespace etude
