#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "sim/performer/faults.h"
#include "sim/performer/session.h"

namespace etude {
namespace {

/// Fisher and Yates' shuffle.
template <typename T>
void Shuffle(RandomStream& random, std::vector<T>& items) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.IndexBelow(i)]);
}

template <typename T>
const T& Pick(RandomStream& random, const std::vector<T>& items) {
  return items[random.IndexBelow(items.size())];
}

/// Normal, but never further than two deviations: a right performance must stay right.
double Bounded(RandomStream& random, double mean, double deviation) {
  return mean + deviation * std::clamp(random.Normal(), -2.0, 2.0);
}

/// Indices of moves, `count` of them: every move is asked once before any is asked again.
std::vector<std::size_t> DrawMoves(RandomStream& random, std::size_t move_count, std::size_t count) {
  std::vector<std::size_t> drawn;
  while (drawn.size() < count) {
    std::vector<std::size_t> deck(move_count);
    std::iota(deck.begin(), deck.end(), 0);
    Shuffle(random, deck);
    drawn.insert(drawn.end(), deck.begin(), deck.end());
  }
  drawn.resize(count);
  return drawn;
}

void DrawFault(RandomStream& random, std::span<const Move> moves, const Move& asked, SessionEvent& event) {
  event.fault = Pick(random, ShowableFaults(asked, moves));
  if (event.fault == Fault::kHalfAmplitude) event.amplitude *= kHalfAmplitude;
  if (event.fault == Fault::kWrongMove) event.danced = Pick(random, WrongMoves(asked, moves));
  if (event.fault == Fault::kSkipped) event.danced.clear();
}

}  // namespace

SessionPlan PlanSession(RandomStream& random, std::span<const Move> moves, const SessionOptions& options) {
  assert(!moves.empty());
  const auto count = static_cast<std::size_t>(std::max(0, options.events));
  const double share = std::clamp(options.fault_share, 0.0, 1.0);
  std::vector<char> is_fault(count, 0);
  std::fill_n(is_fault.begin(), std::lround(share * static_cast<double>(count)), 1);
  Shuffle(random, is_fault);

  const double looseness = 2 - std::clamp(options.skill, 0.0, 1.0);
  constexpr double kStandsFirst = 2.0;  // sensors and filters settle
  constexpr double kLeastRest = 1.0;    // the ways out of one move and into the next must not meet
  SessionPlan plan;
  double time = kStandsFirst;
  const std::vector<std::size_t> asked = DrawMoves(random, moves.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const Move& move = moves[asked[i]];
    SessionEvent event{.move = move.name, .danced = move.name, .start_s = time, .first_right_s = {}};
    event.end_s = time + move.beats * 60 / move.tempo_bpm;
    event.delay_s = looseness * random.Uniform(0.02, 0.1);
    event.tempo = Bounded(random, 1, 0.015 * looseness);
    event.amplitude = Bounded(random, 1, 0.02 * looseness);
    if (is_fault[i]) DrawFault(random, moves, move, event);
    time = event.WindowEnd() + std::max(options.rest_s, kLeastRest) + random.Uniform(0, 0.5);
    plan.events.push_back(std::move(event));
  }
  plan.duration_s = time;
  return plan;
}

}  // namespace etude
