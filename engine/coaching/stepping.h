#pragma once

#include <string>
#include <string_view>

#include "engine/coaching/coach.h"

namespace etude {

/// Transitions leave an act this many frames before its end: the body already stands in the ready stance, and enough
/// frames remain for a join.
constexpr int kBeforeEndFrames = 15;

/// One call of Coach::Step: takes the player's input, advances the playback, outputs the pose, and chooses the next
/// mode.
class Stepping {
 public:
  /// Prepares a step. All arguments must outlive this object; `step.state` is changed and `step.output` is filled.
  Stepping(const DanceTransitions& transitions, const CoachOptions& options, const Coach::PolicyChoice& policy,
           const CoachInput& input, CoachStep& step);

  void Run();

 private:
  // Functions that observe the player.
  void Watch();
  PlayerHint WhereToStand() const;
  bool IsIdleFor(double seconds) const;

  // Functions that fill the output.
  void Show();
  void Picture();

  // The state machine: one function per mode.
  void Decide();
  void Wait();
  void DanceOn();
  void Correct();

  // Functions for the music, and for the windows in which performances are judged (stepping_windows.cc).
  void FollowMusic(double dance_frame);
  void OpenWindowAt(double dance_frame);
  void CloseWindow();
  void JudgeEarly();
  void Remember(WindowVerdict verdict);
  WindowVerdict Judge(Mistake& mistake) const;
  void AnswerMistake(Mistake mistake);
  void AnswerMoment(double dance_frame);

  // Functions that change the mode.
  void BeginSong();
  void EndSong();
  void Interrupt(int repetition, std::string why);
  void ReturnToDance();
  void Enter(CoachMode mode, std::string_view act, CoachEvent event, std::string why);
  void Become(CoachMode mode);
  void StopMusic();
  void NoteTransition();

  CoachRecord& Note(CoachEvent event, std::string why);
  void Say(std::string_view words, double seconds);
  int MoveOf(int repetition) const { return dance_.repetitions[repetition].move; }
  const std::string& NameOf(int repetition) const { return dance_.moves[MoveOf(repetition)].name; }

  const DanceTransitions& transitions_;
  const DanceLibrary& library_;
  const etude::Dance& dance_;
  const CoachOptions& options_;
  const Coach::PolicyChoice& policy_;
  const CoachInput& input_;
  CoachState& state_;
  CoachOutput& out_;
};

}  // namespace etude
