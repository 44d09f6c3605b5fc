#include "engine/coaching/coach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/coaching/stepping.h"

namespace etude {

std::string_view EventName(CoachEvent event) {
  constexpr std::array<std::string_view, 15> kNames = {"woken",    "song begins", "right",     "wrong",    "unjudged",
                                                       "corrects", "shows",       "returns",   "goes on",  "praises",
                                                       "tag",      "transition",  "song ends", "attracts", "dozes"};
  return kNames[static_cast<std::size_t>(event)];
}

std::string_view MistakeName(Mistake mistake) {
  constexpr std::array<std::string_view, 4> kNames = {"none", "not reached", "stood still", "wrong side"};
  return kNames[static_cast<std::size_t>(mistake)];
}

std::string_view ModeName(CoachMode mode) {
  constexpr std::array<std::string_view, 8> kNames = {"standby", "attract", "doze",        "wake",
                                                      "dance",   "correct", "demonstrate", "praise"};
  return kNames[static_cast<std::size_t>(mode)];
}

std::string_view HintText(PlayerHint hint) {
  constexpr std::array<std::string_view, 4> kTexts = {"", "come into view", "come nearer", "step back"};
  return kTexts[static_cast<std::size_t>(hint)];
}

Coach::Coach(const DanceTransitions& transitions, const CoachOptions& options, PolicyChoice policy)
    : transitions_(transitions), options_(options), policy_(std::move(policy)) {}

CoachState Coach::Begin() const {
  CoachState state;
  state.playback.path = transitions_.Alone(transitions_.library().ClipOfAct("standby"));
  state.moves.resize(dance().moves.size());
  return state;
}

CoachState Coach::BeginDancing() const {
  CoachState state = Begin();
  state.mode = CoachMode::kDance;
  state.playback = {};
  return state;
}

void Coach::PlanAhead() const {
  const DanceLibrary& library = transitions_.library();
  const auto last_of = [&](int clip) { return static_cast<int>(library.library().motions[clip].poses.size()) - 1; };
  const double lag = options_.reaction_s * kJudgedRateHz;
  const int repetitions = static_cast<int>(dance().repetitions.size());
  for (const char* act : {"head_shake", "wave", "puzzled"}) {
    const int whole = library.ClipOfAct(act);
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      const double closes = static_cast<double>(dance().repetitions[repetition].end) + lag;
      const int clip = library.ClipLeaving(library.RepetitionAt(closes));
      const int frame = static_cast<int>(std::ceil(closes - static_cast<double>(library.DanceFrameOf(clip))));
      // A dance that is hurried or slowed closes its windows a frame sooner or later.
      for (int late = -1; late <= 1; ++late) {
        if (frame + late > last_of(clip)) continue;
        transitions_.Find(clip, frame + late, library.ClipEntering(whole));
      }
    }
    for (int move = 0; move < static_cast<int>(dance().moves.size()); ++move) {
      transitions_.Find(whole, std::max(last_of(whole) - kBeforeEndFrames, 0),
                        library.ClipEntering(library.ClipOfSlow(move)));
    }
  }
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const int slow = library.ClipOfSlow(dance().repetitions[repetition].move);
    transitions_.Find(slow, std::max(last_of(slow) - kBeforeEndFrames, 0), library.ClipReturning(repetition));
  }
  const int ending = library.ClipLeaving(repetitions - 1);
  for (const char* act : {"praise", "standby"}) {
    transitions_.Find(ending, last_of(ending), library.ClipEntering(library.ClipOfAct(act)));
  }
}

CoachStep Coach::Step(CoachState state, const CoachInput& input) const {
  CoachStep step{std::move(state), {}};
  Stepping(transitions_, options_, policy_, input, step).Run();
  return step;
}

}  // namespace etude
