#pragma once

#include "bench/tasks/base/task.h"
#include "bench/tasks/transition/outcome.h"
#include "bench/tasks/transition/stage.h"

namespace etude {

/// The curve of largest second differences from one second before the first seam to one second after the last.
Series JumpSeries(const TransitionOutcome& outcome);

/// What explains a switch in numbers, for every cell that is asked to keep it: `meeting_partials`, ten for each seam
/// (axis "feature"), and one value for each candidate (axis "candidate"): `candidate_meeting`, `candidate_from_frame`,
/// `candidate_to_frame`, `candidate_distance`, `candidate_fate` (0 taken, 1 too far, 2 later, 3 worse), and its ten
/// `candidate_partials` (axis "feature").
std::vector<Series> ExplanationOf(const TransitionRecord& record);

/// The switch, which must have a way, with 2.5 s before and after it: track "coach", and the facts that explain it.
///
///     {"transition_frame": 60, "transition_frames": [60, 75], "from": "builtin:clap", "to": …, "branch": "in-between",
///      "why": "no match among …", "request_frame": 52, "wait_s": 0.8, "threshold": 0.4, "natural_limit_cm": 3.8,
///      "distance": 0.31, "weights": {"RH": 1, …}, "partials": {"RH": 0.02, …}, "pairs_seen": 900, "pairs_matched": 0,
///      "switches": [{"from": …, "from_frame": 60, "to": "in-between", "to_frame": 0, "distance": …,
///                    "partials": …}, …],
///      "cost_unit": "cm",
///      "candidates": [{"meeting": 0, "from_frame": 60, "to_frame": 12, "distance": 0.31, "partials": {"RH": …},
///                      "cost": 8.2, "outcome": "taken"}, …]}
///
/// `transition_frames` and `request_frame` count in the recording (a negative one is before it begins), all other
/// frames in their clips. `distance` and `partials` beside them are those of the worst of the switches. `meeting` tells
/// which of the switches a candidate was looked at for; `cost` is null for choices that rank by nothing.
Recording RecordTransition(const TransitionOutcome& outcome, const Stage& stage);

}  // namespace etude
