#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/transition/outcome.h"
#include "bench/tasks/transition/stage.h"
#include "engine/transitions/joins/splice.h"

namespace etude {

/// Describes the stage to outside methods, which must find transitions. Clips are identified by their index in the
/// setting, frames by their index in the clip. A pose is sixty numbers (EncodePose).
///
/// The setting holds the clips that built-in methods receive, all performed by one body:
///
///     {"rate_hz": 30, "joints": ["hip_centre", …], "parents": [null, "hip_centre", …],
///      "clips": [{"name": "builtin:clap", "poses": [[x, y, z, …], …], "file": "clip-0.bvh"}, …]}
///
/// The files hold the same poses, for other tools.
Payload StagePayload(const Stage& stage);

/// Encodes the problem: clip `from` plays its frame `request_frame` when clip `to` is requested.
///
///     {"from": 0, "to": 3, "request_frame": 41, "max_wait_s": 1}
///
/// `max_wait_s` is the scenario's `wait_s`: the longest wait that the caller wants. A later transition is allowed; its
/// wait counts in metric `wait_s`, like the wait of the built-in choice `wait-for-end`.
Payload RequestPayload(const TransitionRequest& request, double max_wait_s);

/// Encodes the truth: the largest jump that still counts as natural in `natural_share`.
///
///     {"natural_limit_cm": 3.1}
Payload NaturalLimitPayload(const Stage& stage, const TransitionRequest& request);

/// The answer of an outside method, which describes the transition:
///
///     {"leave_frame": 52, "enter_frame": 10}
///
/// Clip `from` is shown up to and including `leave_frame`. After it, clip `to` is shown from the frame after
/// `enter_frame` to its end, so `leave_frame` and `enter_frame` belong to the same moment. Clip `to` is turned and
/// moved on the floor (yaw, x, z) until its `enter_frame` has the heading and the hip centre's floor position of the
/// last frame shown. Optional keys:
///
/// - `"through": [{"clip": 2, "enter_frame": 3, "leave_frame": 40}]`: clips played in between, entered and left by the
///   same rule.
/// - `"join"`: a built-in join, which has its default settings; `cut` if absent.
/// - `"join_s": 0.5`: the duration of `minimum-jerk` or `planted-feet`, 0 to 5 s. Together with `join_s`,
///   `"fades": true` makes the old clip continue while it fades out, or `"direct": true` makes each limb move with
///   minimum jerk to its pose in the new clip at the join's end. Other joins have durations of their own.
/// - `"between": [[x, y, z, …], …]`: the method's own frames, shown after `leave_frame`. They have the coordinates of
///   clip `from` in the setting. Clip `to` is then aligned with the last of these frames, which should be the method's
///   own version of `enter_frame`. The body must be the clips' body: a limb that is more than 2 cm longer or shorter is
///   an error. There may be at most 300 frames, and no `through`.
/// - `"between_start": [x, y, z, …]`: with `between`, the method's version of `leave_frame`. This pose is not shown;
///   the gaps at the transition point are measured from `leave_frame` to this pose. Without `between_start`, the frames
///   of `between` are assumed to begin at constant velocity.
/// - `"matched": true`: the two frames of the transition point were chosen because they are similar. Only then
///   `false_smooth` is measured.
///
/// A method that finds no transition answers `{"unsolved": "why"}`. Its cell ends like that of a built-in method that
/// finds no match.
struct TransitionAnswer {
  std::optional<std::string> unsolved;  ///< why there is no transition; the other members are then empty
  std::vector<Segment> segments;        ///< the segments, in the form of a TransitionRecord
  const JoinKind* join = nullptr;       ///< the join, with default settings; not null if there are segments
  bool matched = false;
};

/// Reads an answer. Fails if it breaks the rules of TransitionAnswer, naming the position in the answer.
Result<TransitionAnswer> ReadTransitionAnswer(const Json& answer, const Stage& stage, const TransitionRequest& request);

/// Returns the curve of the largest second difference of any joint, from one second before the first transition point
/// to one second after the last.
Series JumpSeries(const TransitionOutcome& outcome);

/// Returns the numbers that explain a transition, for cells that keep these numbers. `point_partials` has ten values
/// for each transition point (axis "feature"). The following series have one value for each candidate (axis
/// "candidate"): `candidate_point`, `candidate_from_frame`, `candidate_to_frame`, `candidate_distance`, and
/// `candidate_outcome` (0 taken, 1 too far, 2 later, 3 worse). `candidate_partials` has ten values for each candidate
/// (axis "feature").
std::vector<Series> ExplanationOf(const TransitionRecord& record);

/// Records the motion from 2.5 s before the transition to at least 2.5 s after it, as far as the motion goes: the track
/// "coach", the clips, and TransitionExtras. The outcome's record must have segments.
Recording RecordTransition(const TransitionOutcome& outcome, const Stage& stage);

}  // namespace etude
