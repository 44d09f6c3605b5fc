// Functions of Stepping that open windows, judge performances, and react to the verdicts.
#include <fmt/format.h>

#include <utility>

#include "engine/coaching/stepping.h"

namespace etude {
namespace {

constexpr double kWordsSeconds = 2;

std::string_view WordsOf(Mistake mistake) {
  switch (mistake) {
    case Mistake::kStoodStill:
      return "Dance with me!";
    case Mistake::kWrongSide:
      return "The other side";
    default:
      return "Let us look at that again";
  }
}

}  // namespace

void Stepping::OpenWindowAt(double dance_frame) {
  if (state_.open || state_.next_window >= static_cast<int>(dance_.repetitions.size())) return;
  const int index = state_.next_window;
  const Repetition& repetition = dance_.repetitions[index];
  const double opens = static_cast<double>(repetition.first) + options_.reaction_s * kJudgedRateHz;
  if (dance_frame < opens) return;
  ++state_.next_window;
  // If the dance is already more than this number of frames past the window's opening, because a transition entered
  // it there, the player has not seen all of the repetition, so no window opens.
  constexpr double kLateFrames = 3;
  if (dance_frame > opens + kLateFrames) return;
  state_.open = {.repetition = index, .move = repetition.move};
  state_.decided = false;
  ResetCounts(state_.stillness);
}

WindowVerdict Stepping::Judge(Mistake& mistake) const {
  mistake = Mistake::kNone;
  if (policy_.policy->asks_truth) {
    if (!input_.told_right) return WindowVerdict::kUnknown;
    mistake = *input_.told_right ? Mistake::kNone : Mistake::kNotReached;
    return *input_.told_right ? WindowVerdict::kRight : WindowVerdict::kWrong;
  }
  if (2 * state_.stillness.seen < state_.stillness.frames) return WindowVerdict::kUnknown;
  if (state_.stillness.moving < options_.still_share * state_.stillness.seen) {
    mistake = Mistake::kStoodStill;
  } else if (input_.evidence.asked < options_.right_from) {
    const bool is_mirrored = input_.other_side && *input_.other_side >= options_.right_from;
    mistake = is_mirrored ? Mistake::kWrongSide : Mistake::kNotReached;
  }
  return mistake == Mistake::kNone ? WindowVerdict::kRight : WindowVerdict::kWrong;
}

void Stepping::JudgeEarly() {
  if (!state_.open || state_.decided || policy_.policy->asks_truth) return;
  if (input_.evidence.asked < options_.right_from) return;
  Mistake mistake{};
  if (Judge(mistake) == WindowVerdict::kRight) Remember(WindowVerdict::kRight);
}

void Stepping::Remember(WindowVerdict verdict) {
  // Count the verdict for the move and for the song.
  const OpenWindow window = *state_.open;
  const bool was_wrong = state_.moves[window.move].mistakes_in_row > 0;
  if (verdict != WindowVerdict::kUnknown) {
    for (MoveMemory* memory : {&state_.moves[window.move], &state_.song}) {
      ++memory->judged;
      memory->mistakes += verdict == WindowVerdict::kWrong ? 1 : 0;
      memory->mistakes_in_row = verdict == WindowVerdict::kWrong ? memory->mistakes_in_row + 1 : 0;
    }
  }
  state_.decided = true;
  // Record the verdict. If the performance is right and the previous one was wrong, praise the player.
  const auto note = [&](CoachEvent event, std::string why) {
    CoachRecord& record = Note(event, std::move(why));
    record.repetition = window.repetition;
    record.move = window.move;
    record.evidence = input_.evidence.asked;
    return &record;
  };
  const double evidence = input_.evidence.asked;
  if (verdict == WindowVerdict::kUnknown) {
    note(CoachEvent::kUnjudged, fmt::format("seen in {} of {} frames", state_.stillness.seen, state_.stillness.frames));
  } else if (verdict == WindowVerdict::kRight) {
    note(CoachEvent::kRight,
         fmt::format("evidence {:.2f}; a move counts as right from {:.2f} on", evidence, options_.right_from));
    if (state_.correcting == window.repetition) state_.corrections_here = 0;
    if (!was_wrong) return;
    note(CoachEvent::kPraises, "the player is right after a mistake in this move");
    Say("Well done!", kWordsSeconds);
  }
}

void Stepping::CloseWindow() {
  if (!state_.open) return;
  const Repetition& repetition = dance_.repetitions[state_.open->repetition];
  const double dance_frame = DanceFrame(state_.playback, library_);
  const bool ends = IsOver(state_.playback, library_);
  if (!ends && dance_frame < static_cast<double>(repetition.end) + options_.reaction_s * kJudgedRateHz) return;
  Mistake mistake = Mistake::kNone;
  if (!state_.decided) {
    const WindowVerdict verdict = Judge(mistake);
    Remember(verdict);
    if (verdict == WindowVerdict::kWrong) AnswerMistake(mistake);
  }
  state_.open.reset();
}

void Stepping::AnswerMistake(Mistake mistake) {
  const OpenWindow window = *state_.open;
  const double evidence = input_.evidence.asked;
  // Record the mistake.
  CoachRecord& record = Note(
      CoachEvent::kWrong,
      fmt::format("{}: evidence {:.2f} (right from {:.2f} on); the player moved in {} of {} frames",
                  MistakeName(mistake), evidence, options_.right_from, state_.stillness.moving, state_.stillness.seen));
  record.repetition = window.repetition;
  record.move = window.move;
  record.mistake = mistake;
  record.evidence = evidence;
  // Let the policy decide, but do not exceed the maximum number of corrections of one repetition.
  const PolicyInput asked{.verdict = WindowVerdict::kWrong,
                          .evidence = evidence,
                          .right_from = options_.right_from,
                          .move = state_.moves[window.move]};
  PolicyDecision decision = policy_.policy->decide(asked, policy_.settings);
  if (!decision.corrects) return;
  const bool is_last = state_.correcting == window.repetition && state_.corrections_here >= options_.most_corrections;
  if (is_last) {
    Note(CoachEvent::kGoesOn, fmt::format("corrected {} times already", state_.corrections_here)).repetition =
        window.repetition;
    return;
  }
  Interrupt(window.repetition, std::move(decision.why));
  Say(WordsOf(mistake), kWordsSeconds);
}

void Stepping::AnswerMoment(double dance_frame) {
  const int repetition = state_.open ? state_.open->repetition : library_.RepetitionAt(dance_frame);
  if (repetition < 0) return;
  state_.moment_waits = false;
  if (state_.open && !state_.decided) Remember(WindowVerdict::kUnknown);
  Interrupt(repetition, "a moment that was given");
}

}  // namespace etude
