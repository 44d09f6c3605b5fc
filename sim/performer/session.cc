#include "sim/performer/session.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <string_view>

#include "engine/base/named.h"
#include "engine/base/smoothstep.h"
#include "sim/choreography/canonical_body.h"
#include "sim/performer/rendition.h"
#include "sim/performer/style.h"

namespace etude {
namespace {

/// Shuffles items (Fisher–Yates).
template <typename T>
void Shuffle(RandomStream& random, std::vector<T>& items) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.IndexBelow(i)]);
}

/// Draws the indices of `count` moves. No move is repeated before all moves were drawn.
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

/// Adds one random fault that the move can show and that the event does not have yet; adds nothing if no such fault is
/// found.
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

/// An event's rendition, placed at the event's time in the session.
class Dance {
 public:
  Dance(const SessionEvent& event, Rendition rendition)
      : rendition_(std::move(rendition)),
        starts_s_(event.start_s + event.chance.lag_s),
        length_s_(event.end_s - starts_s_),
        late_s_(rendition_.Lateness() * length_s_) {
    vigour_ = VigourAfter(rendition_.style().person(), event.start_s);
  }

  /// Returns the weight of the dance in the blend with standing: 0 outside the event, 1 inside.
  double Weight(double time_s) const {
    const double since = time_s - starts_s_ - late_s_;
    const double inside =
        std::min(Smootherstep(1 + since / kBlendSeconds), Smootherstep(1 - (since - length_s_) / kBlendSeconds));
    return inside > 0 ? inside * rendition_.Presence(ShareAt(time_s)) : 0;
  }

  Controls At(double time_s) const { return rendition_.Danced(ShareAt(time_s), vigour_); }

  PerformanceDeviation Deviation() const { return rendition_.Deviation(); }
  /// Returns the time at which the performance reaches beat `beat` of the move.
  double TimeOf(double beat) const {
    return starts_s_ + length_s_ * rendition_.DueOf(beat / rendition_.style().move().beats);
  }

 private:
  double ShareAt(double time_s) const {
    const double eased = EasedTime(time_s - starts_s_ - late_s_, length_s_);
    return rendition_.DancedShare((eased + late_s_) / length_s_);
  }

  Rendition rendition_;
  double starts_s_, length_s_, late_s_;
  double vigour_ = 1;
};

/// Returns the person's style for every move in a plan.
std::map<std::string_view, Style> StylesFor(const SessionPlan& plan, std::span<const Move> moves,
                                            const Person& person) {
  std::map<std::string_view, Style> styles;
  for (const SessionEvent& event : plan.events) {
    for (const std::string& name : {event.move, event.danced}) {
      if (name.empty()) continue;
      const Move* move = FindByName(moves, name);
      assert(move != nullptr);
      styles.try_emplace(move->name, person, *move);
    }
  }
  return styles;
}

}  // namespace

SessionPlan PlanSession(RandomStream& random, std::span<const Move> moves, const Person& person,
                        const SessionOptions& options) {
  assert(!moves.empty());
  // Choose which events have faults.
  const auto count = static_cast<std::size_t>(std::max(0, options.events));
  const double share = std::clamp(options.fault_share, 0.0, 1.0);
  std::vector<char> is_fault(count, 0);
  std::fill_n(is_fault.begin(), std::lround(share * static_cast<double>(count)), 1);
  Shuffle(random, is_fault);

  constexpr double kStandsFirst = 2.0;  // time that sensors and filters need to settle
  constexpr double kMinRest = 1.0;      // s; so that the blend out of a move ends before the blend into the next begins
  SessionPlan plan;
  double time = kStandsFirst;
  const std::vector<std::size_t> asked = DrawMoves(random, moves.size(), count);
  // Lay out the events one after the other.
  for (std::size_t i = 0; i < count; ++i) {
    const Move& move = moves[asked[i]];
    SessionEvent event;
    event.move = event.danced = move.name;
    event.start_s = time;
    event.chance = DrawChance(random, person);
    event.end_s = time + event.chance.lag_s + move.beats * 60 / (move.tempo_bpm * event.chance.tempo);
    // Draw the event's faults. An absent person only stands still.
    if (person.kind == People::kAbsent) {
      event.faults = {{Fault::kSkipped, 1, 0}};
      event.danced.clear();
    } else if (is_fault[i]) {
      AddFault(random, moves, options, event);
      if (random.Chance(options.two_faults)) AddFault(random, moves, options, event);
    }
    time = event.WindowEnd() + std::max(options.rest_s, kMinRest) + random.Uniform(0, 0.5);
    plan.events.push_back(std::move(event));
  }
  plan.duration_s = time;
  return plan;
}

Performance Perform(RandomStream& random, std::span<const Move> moves, const Person& person, const SessionPlan& plan) {
  const auto styles = StylesFor(plan, moves, person);
  std::vector<Dance> dances;
  for (const SessionEvent& event : plan.events) {
    const Style* instead = event.danced.empty() ? nullptr : &styles.at(event.danced);
    dances.emplace_back(event, Rendition(styles.at(event.move), event.chance, event.faults, instead));
  }

  // Compute every frame: blend the dances at the frame's time with the swaying body at rest.
  Performance performance{.person = person, .motion = {}, .events = plan.events};
  const Sway sway(random);
  const Controls rest = RestOf(person);
  const auto frames = static_cast<std::size_t>(std::ceil(plan.duration_s * kJudgedRateHz));
  for (std::size_t frame = 0; frame < frames; ++frame) {
    const double time_s = static_cast<double>(frame) / kJudgedRateHz;
    Controls controls = Sum(rest, sway.At(time_s));
    for (const Dance& dance : dances) {
      const double weight = dance.Weight(time_s);
      if (weight > 0) controls = Mix(controls, dance.At(time_s), weight);
    }
    performance.motion.poses.push_back(person.place.Apply(PoseOf(controls, person.body)));
  }
  // Judge every event.
  for (std::size_t i = 0; i < dances.size(); ++i) {
    SessionEvent& event = performance.events[i];
    event.deviation = dances[i].Deviation();
    event.truth = TruthOf(event.deviation);
    if (event.IsRight()) event.first_right_s = dances[i].TimeOf(FindByName(moves, event.move)->key_poses.back().beat);
  }
  return performance;
}

}  // namespace etude
