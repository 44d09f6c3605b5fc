#pragma once

#include <memory>
#include <optional>
#include <string>

#include "bench/tasks/base/task.h"
#include "bench/tasks/coach/options.h"
#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"

namespace etude {

/// Describes the dance to programs in a seat of the loop, which answer step by step; a step is a frame at 30 Hz. A pose
/// is sixty numbers (EncodePose).
///
/// Setting, for every seat: the moves of the dance as recognisers are taught them (detection's setting), and
///
///     "dance": {"title": "groove", "tempo_bpm": 112, "rate_hz": 30, "repetitions": [{"move": "clap"}, …]}
Payload DancePayload(const CoachStage& stage);

/// Encodes the beginning of a session: {"seat": "recogniser"}.
Payload SessionBeginPayload(Seat seat);

/// A program in a seat of a session, with the first complaint about its answers.
class SeatedCoachProgram {
 public:
  /// Both must outlive it.
  SeatedCoachProgram(LiveProgram& program, const CoachStage& stage) : program_(program), stage_(stage) {}

  const CoachStage& stage() const { return stage_; }
  /// Sends a step and returns the answer; null if the program has failed, or after a complaint: then it is not asked
  /// again.
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

/// Makes a recogniser whose part a program plays. A step holds what the sensor reports and, when a window opens or
/// closes, the move that is asked for from this frame on:
///
///     {"pose": [x, y, z, …], "states": "tttiii…", "body_seen": true, "ask": {"move": "clap"}}     or "move": null
///
/// The answer is how right the requested performance looks so far, 0…1 (the largest value counts, as long as the
/// request is the same), and optionally `spotted`, the same for every move, requested or not.
///
///     {"asked": 0.7, "spotted": [0, 0.1, …]}
///
/// `program` must outlive the recogniser and its follower.
std::unique_ptr<Recogniser> MakeSeatedRecogniser(SeatedCoachProgram& program);

/// Makes a policy whose part a program plays. A step holds what the coach showed in the frame before, and its verdicts
/// on the windows that closed in that frame:
///
///     {"mode": "dance", "move": "clap", "repetition": 3,
///      "verdicts": [{"move": "clap", "repetition": 2, "verdict": "wrong", "mistake": "not reached", "evidence": 0.3}]}
///
/// Answer: {"correct": true} interrupts the dance now, or as soon as the coach dances.
std::unique_ptr<MomentSource> MakeSeatedPolicy(SeatedCoachProgram& program);

/// Makes a learner whose part a program plays. A step holds the content of the screen and the decisions of this frame:
///
///     {"pose": [x, y, z, …], "mode": "dance", "clip": "dance", "clip_frame": 120, "move": "clap", "repetition": 3,
///      "say": "Watch!", "hint": "both arms up", "events": ["wrong", "corrects"]}
///
/// The answer holds the learner's next pose in the world (the sensor stands in front of it, in the direction of +Z),
/// whether its present performance is right (null: grey), and whether its patience has run out:
///
///     {"pose": [x, y, z, …], "right": true, "given_up": false}
///
/// After the session the learner is tested on every move, after the time that 20 performances would take:
/// {"test": {"move": "clap", "after": 20}}, answered by {"right": true}.
std::unique_ptr<Player> MakeSeatedLearner(SeatedCoachProgram& program);

/// Records what a film of a session shows: tracks "coach", "truth" (the learner's real motion) and "sensed", and
/// CoachExtras.
Recording RecordCoaching(const CoachStage& stage, const SessionLog& log);

}  // namespace etude
