#pragma once

#include <memory>
#include <optional>
#include <string>

#include "bench/tasks/base/task.h"
#include "bench/tasks/coach/options.h"
#include "bench/tasks/coach/session.h"
#include "bench/tasks/coach/world.h"

namespace etude {

/// Describes the dance to programs in a seat of the loop, which are told and answer step by step; a step is a frame at
/// 30 Hz. A pose is sixty numbers (EncodePose).
///
/// Setting, whatever the seat: the moves of the dance as recognisers are taught them (detection's setting), and
///
///     "dance": {"title": "groove", "tempo_bpm": 112, "rate_hz": 30, "repetitions": [{"move": "clap"}, …]}
Payload DancePayload(const CoachStage& stage);

/// Makes the beginning of a session: {"seat": "recogniser"}.
Payload SessionBeginPayload(Seat seat);

/// A program in a seat of a session, and the first complaint about its answers.
class SeatedCoachProgram {
 public:
  /// Both must outlive it.
  SeatedCoachProgram(LiveProgram& program, const CoachStage& stage) : program_(program), stage_(stage) {}

  const CoachStage& stage() const { return stage_; }
  /// Puts a step to it; null when it has failed, or after a complaint: then nothing more is asked.
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

/// Makes a recogniser that a program plays. Step: what the sensor reports, and, where a window opens or closes, what is
/// asked for from this frame on:
///
///     {"pose": [x, y, z, …], "states": "tttiii…", "body_seen": true, "ask": {"move": "clap"}}     or "move": null
///
/// Answer: how right the performance asked for looks so far, 0…1 (it may not fall while the same one is asked for: the
/// largest so far counts); `spotted`, which may be left out, the same of every move whether asked for or not.
///
///     {"asked": 0.7, "spotted": [0, 0.1, …]}
///
/// What it points to must outlive it and its follower.
std::unique_ptr<Recogniser> MakeSeatedRecogniser(SeatedCoachProgram& program);

/// Makes a policy that a program plays. Step: what the coach showed in the frame before, and what it made of the
/// windows that closed in it:
///
///     {"mode": "dance", "move": "clap", "repetition": 3,
///      "verdicts": [{"move": "clap", "repetition": 2, "verdict": "wrong", "mistake": "not reached", "evidence": 0.3}]}
///
/// Answer: {"correct": true} interrupts the dance now, or as soon as there is one.
std::unique_ptr<MomentSource> MakeSeatedPolicy(SeatedCoachProgram& program);

/// Makes a learner that a program plays. Step: what is on the screen and what was decided in this frame:
///
///     {"pose": [x, y, z, …], "mode": "dance", "clip": "dance", "clip_frame": 120, "move": "clap", "repetition": 3,
///      "say": "Watch!", "hint": "both arms up", "events": ["wrong", "corrects"]}
///
/// Answer: its own next pose, in the world (the sensor stands before it, in the direction of +Z), how the performance
/// is that it dances now (null: neither right nor wrong), and whether its patience has run out:
///
///     {"pose": [x, y, z, …], "right": true, "given_up": false}
///
/// After the session, for every move: {"test": {"move": "clap", "after": 20}}, so many performances' time later,
/// answered by {"right": true}.
std::unique_ptr<Player> MakeSeatedLearner(SeatedCoachProgram& program);

/// Records what a film of a session shows: tracks "coach", "truth" (the learner as danced) and "sensed", and
/// CoachExtras.
Recording RecordCoaching(const CoachStage& stage, const SessionLog& log);

}  // namespace etude
