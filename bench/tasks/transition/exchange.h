#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/transition/outcome.h"
#include "bench/tasks/transition/stage.h"
#include "bench/tasks/transition/world.h"
#include "engine/transitions/joins/splice.h"

namespace etude {

/// Describes the stage to methods outside the program, which are asked for transitions. Clips are named by their index
/// in the setting, frames by theirs in the clip; a pose is sixty numbers (EncodePose).
///
/// Setting, the clips as built-in methods see them, performed by one body:
///
///     {"rate_hz": 30, "joints": ["hip_centre", …], "parents": [null, "hip_centre", …],
///      "clips": [{"name": "builtin:clap", "poses": [[x, y, z, …], …], "file": "clip-0.bvh"}, …]}
///
/// The files hold the same poses, for other tools.
Payload StagePayload(const Stage& stage);

/// Makes the problem: clip `from` shows its frame `request_frame` when clip `to` is asked for.
///
///     {"from": 0, "to": 3, "request_frame": 41, "max_wait_s": 1}
///
/// `max_wait_s` is the scenario's `wait_s`: how long the caller would like to wait at most. A later transition is
/// allowed and costs `wait_s`, as that of the built-in `wait-for-end` does.
Payload RequestPayload(const TransitionRequest& request, double max_wait_s);

/// Makes the truth: the largest jump that still counts in `natural_share`.
///
///     {"natural_limit_cm": 3.1}
Payload NaturePayload(const Stage& stage, const TransitionRequest& request);

/// The answer of a method outside, how it gets from one clip into the other:
///
///     {"leave_frame": 52, "enter_frame": 10}
///
/// Clip `from` is shown up to `leave_frame`; that moment is also `enter_frame` of clip `to`, of which the next frame
/// is shown then, and so on to its end. Clip `to` is turned and moved on the floor (yaw, x, z), so that `enter_frame`
/// lies on the last frame shown: heading on heading, hip centre over hip centre. May be said beside:
///
/// - `"through": [{"clip": 2, "enter_frame": 3, "leave_frame": 40}]`: clips played on the way, entered and left alike.
/// - `"join"`: any of the built-in ones, `cut` by default, with what it is set by left at its defaults.
/// - `"join_s": 0.5`: how long `minimum-jerk` or `planted-feet` should take, 0 to 5 s; beside it `"fades": true`: the
///   old clip goes on while it fades out; or `"direct": true`: each limb goes with least jerk to where the new clip has
///   it at the end. Other joins have lengths of their own.
/// - `"between": [[x, y, z, …], …]`: frames of the method's own making, shown after `leave_frame` in the place and
///   heading of clip `from` as the setting has it. Then clip `to` is laid on the last of them, so that one should be
///   the method's version of `enter_frame`. They are performed by the same body: a limb more than 2 cm longer or
///   shorter than in the clips is refused. At most 300. Not together with `through`.
/// - `"between_start": [x, y, z, …]`: beside `between`, the method's version of `leave_frame`: not shown, but the gaps
///   at the transition point are those to it. When left out, the frames between are taken to begin at a steady speed.
/// - `"matched": true`: the frames left and entered were chosen because they are alike. Then `false_smooth` is
///   measured, which is missing else.
///
/// A method that finds no way answers `{"unsolved": "why"}`, like a built-in one that finds no match.
struct TransitionAnswer {
  std::optional<std::string> unsolved;  ///< why; the rest is then empty
  std::vector<Segment> segments;        ///< as in a TransitionRecord
  const JoinKind* join = nullptr;       ///< never null when there are segments; its settings are the defaults
  bool matched = false;
};

/// Reads an answer. Refuses what is not as told above, naming where in it.
Result<TransitionAnswer> ReadTransitionAnswer(const Json& answer, const Stage& stage, const TransitionRequest& request);

/// Makes the curve of largest second differences from one second before the first transition point to one second after
/// the last.
Series JumpSeries(const TransitionOutcome& outcome);

/// Explains a transition in numbers, for every cell that is asked to keep them: `point_partials`, ten for each
/// transition point (axis "feature"), and one value for each candidate (axis "candidate"): `candidate_point`,
/// `candidate_from_frame`, `candidate_to_frame`, `candidate_distance`, `candidate_outcome` (0 taken, 1 too far, 2
/// later, 3 worse), and its ten `candidate_partials` (axis "feature").
std::vector<Series> ExplanationOf(const TransitionRecord& record);

/// Records the transition, which must have a way, with 2.5 s before and after it: track "coach", and TransitionExtras.
Recording RecordTransition(const TransitionOutcome& outcome, const Stage& stage);

}  // namespace etude
