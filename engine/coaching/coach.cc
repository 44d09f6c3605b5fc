#include "engine/coaching/coach.h"

#include <array>
#include <utility>

#include "engine/coaching/stepping.h"

namespace etude {

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

CoachStep Coach::Step(CoachState state, const CoachInput& input) const {
  CoachStep step{std::move(state), {}};
  Stepping(transitions_, options_, policy_, input, step).Run();
  return step;
}

}  // namespace etude
