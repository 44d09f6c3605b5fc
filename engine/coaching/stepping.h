#pragma once

#include <string>
#include <string_view>

#include "engine/coaching/coach.h"

namespace etude {

/// An act is left so long before its end, while it is at rest in the ready stance: a join has something to go on with.
constexpr int kBeforeEndFrames = 15;

/// One frame of Coach::Step: takes the player in, goes on playing, shows that, and decides what comes next.
class Stepping {
 public:
  /// Prepares a step. Everything must outlive this; `step.state` is changed, `step.output` filled.
  Stepping(const DanceTransitions& transitions, const CoachOptions& options, const Coach::PolicyChoice& policy,
           const CoachInput& input, CoachStep& step);

  void Run();

 private:
  // The player.
  void Watch();
  PlayerHint WhereToStand() const;
  bool IsIdleFor(double seconds) const;

  // What is shown.
  void Show();
  void Picture();

  // The machine, by mode.
  void Decide();
  void Wait();
  void DanceOn();
  void Correct();

  // The dance's music and windows (these in stepping_windows.cc).
  void FollowMusic(double dance_frame);
  void OpenWindowAt(double dance_frame);
  void CloseWindow();
  void JudgeEarly();
  void Remember(WindowVerdict verdict);
  WindowVerdict Judge(Mistake& mistake) const;
  void AnswerMistake(Mistake mistake);
  void AnswerMoment(double dance_frame);

  // Ways from mode to mode.
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
