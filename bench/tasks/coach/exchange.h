#pragma once

#include <memory>
#include <optional>

#include "bench/tasks/base/task.h"
#include "bench/tasks/coach/options.h"
#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"

namespace etude {

/// Describes the dance to programs that replace a part of the loop (a seat). They answer step by step; a step is a
/// frame at 30 Hz. A pose is sixty numbers (EncodePose).
///
/// The setting is the same for every seat. It holds the moves of the dance as recognisers are taught them (the setting
/// of task detection), and
///
///     "dance": {"title": "groove", "tempo_bpm": 112, "rate_hz": 30, "repetitions": [{"move": "clap"}, …]}
Payload DancePayload(const CoachStage& stage);

/// Encodes the beginning of a session: {"seat": "recogniser"}.
Payload SessionBeginPayload(Seat seat);

/// A program that replaces one part of a session's loop (its seat). Keeps the first error in its answers.
class SeatedCoachProgram {
 public:
  /// `program` and `stage` must outlive this object.
  SeatedCoachProgram(LiveProgram& program, const CoachStage& stage) : program_(program), stage_(stage) {}

  const CoachStage& stage() const { return stage_; }
  /// Sends a step and returns the answer. Returns null if the program has failed, or after an error; the program is
  /// then not asked again.
  JsonPtr Step(Json step);
  void Note(const Result<void>& read) {
    if (!read && !error_) error_ = read.error();
  }
  const std::optional<Error>& error() const { return error_; }

 private:
  LiveProgram& program_;
  const CoachStage& stage_;
  std::optional<Error> error_;
};

/// Makes a recogniser that asks a program. A step holds the sensor's report and, when a window opens or closes, the
/// move that is requested from this frame on:
///
///     {"pose": [x, y, z, …], "states": "tttiii…", "body_seen": true, "ask": {"move": "clap"}}     or "move": null
///
/// The answer `asked` is how right the requested performance looks so far, 0…1; the largest value during a request
/// counts. The optional `spotted` gives such a value for every move, requested or not.
///
///     {"asked": 0.7, "spotted": [0, 0.1, …]}
///
/// `program` must outlive the recogniser and its MoveFollower.
std::unique_ptr<Recogniser> MakeSeatedRecogniser(SeatedCoachProgram& program);

/// Makes a policy that asks a program. A step holds the state of the coach in the previous frame, and its verdicts on
/// the windows that closed in that frame:
///
///     {"mode": "dance", "move": "clap", "repetition": 3,
///      "verdicts": [{"move": "clap", "repetition": 2, "verdict": "wrong", "mistake": "not reached", "evidence": 0.3}]}
///
/// The answer {"correct": true} makes the coach interrupt the dance. If the coach does not dance at present, it
/// interrupts as soon as it dances again.
std::unique_ptr<MomentSource> MakeSeatedPolicy(SeatedCoachProgram& program);

/// Makes a learner that asks a program. A step holds the content of the screen and the coach's decisions in this frame:
///
///     {"pose": [x, y, z, …], "mode": "dance", "clip": "dance", "clip_frame": 120, "move": "clap", "repetition": 3,
///      "say": "Watch!", "hint": "both arms up", "events": ["wrong", "corrects"]}
///
/// The answer holds the learner's next pose in the world (the sensor stands in front of the learner, in the direction
/// of +Z). `right` is true if the present performance is right, null if it is grey. `given_up` is true if the learner's
/// patience has run out:
///
///     {"pose": [x, y, z, …], "right": true, "given_up": false}
///
/// After the session, and a pause as long as 20 performances, the learner is tested on every move. The step is {"test":
/// {"move": "clap", "after": 20}}, the answer {"right": true}.
std::unique_ptr<Player> MakeSeatedLearner(SeatedCoachProgram& program);

/// Records a session for a film: CoachExtras and the tracks "coach", "truth" (the learner's real motion) and "sensed".
Recording RecordCoaching(const CoachStage& stage, const SessionLog& log);

}  // namespace etude
