#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "engine/base/named.h"
#include "sim/performer/session.h"

namespace etude {
namespace {

/// Fisher and Yates' shuffle.
template <typename T>
void Shuffle(RandomStream& random, std::vector<T>& items) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.IndexBelow(i)]);
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

/// One more fault that the move can show, in another way than those it has; none when there is no such fault.
void AddFault(RandomStream& random, std::span<const Move> moves, const SessionOptions& options, SessionEvent& event) {
  const Move& asked = *FindByName(moves, event.move);
  std::vector<Fault> left = options.faults.empty() ? AllFaults() : options.faults;
  std::erase_if(left, [&](Fault fault) {
    return std::ranges::find(event.faults, fault, &GradedFault::fault) != event.faults.end();
  });
  Shuffle(random, left);
  const double severity = random.Uniform();
  for (Fault fault : left) {
    const GradedFault graded{fault, options.severity.value_or(severity), random.Uniform()};
    const Move* instead = &moves[random.IndexBelow(moves.size())];
    if (fault == Fault::kWrongMove && instead->name == asked.name) continue;
    if (!CanShow(graded, asked, instead)) continue;
    event.faults.push_back(graded);
    if (fault == Fault::kWrongMove) event.danced = instead->name;
    if (fault == Fault::kSkipped && graded.severity == 1) event.danced.clear();
    return;
  }
}

}  // namespace

SessionPlan PlanSession(RandomStream& random, std::span<const Move> moves, const Person& person,
                        const SessionOptions& options) {
  assert(!moves.empty());
  const auto count = static_cast<std::size_t>(std::max(0, options.events));
  const double share = std::clamp(options.fault_share, 0.0, 1.0);
  std::vector<char> is_fault(count, 0);
  std::fill_n(is_fault.begin(), std::lround(share * static_cast<double>(count)), 1);
  Shuffle(random, is_fault);

  constexpr double kStandsFirst = 2.0;  // sensors and filters settle
  constexpr double kLeastRest = 1.0;    // the ways out of one move and into the next must not meet
  SessionPlan plan;
  double time = kStandsFirst;
  const std::vector<std::size_t> asked = DrawMoves(random, moves.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    const Move& move = moves[asked[i]];
    SessionEvent event;
    event.move = event.danced = move.name;
    event.start_s = time;
    event.chance = DrawChance(random, person);
    event.end_s = time + event.chance.lag_s + move.beats * 60 / (move.tempo_bpm * event.chance.tempo);
    if (person.kind == People::kAbsent) {
      event.faults = {{Fault::kSkipped, 1, 0}};
      event.danced.clear();
    } else if (is_fault[i]) {
      AddFault(random, moves, options, event);
      if (random.Chance(options.two_faults)) AddFault(random, moves, options, event);
    }
    time = event.WindowEnd() + std::max(options.rest_s, kLeastRest) + random.Uniform(0, 0.5);
    plan.events.push_back(std::move(event));
  }
  plan.duration_s = time;
  return plan;
}

}  // namespace etude
