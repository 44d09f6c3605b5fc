#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <string_view>

#include "engine/base/named.h"
#include "engine/base/smoothstep.h"
#include "sim/choreography/canonical_body.h"
#include "sim/performer/eased_time.h"
#include "sim/performer/session.h"
#include "sim/performer/sway.h"

namespace etude {
namespace {

/// One event, ready to be danced.
class Dance {
 public:
  Dance(const SessionEvent& event, Rendition rendition)
      : rendition_(std::move(rendition)),
        starts_s_(event.start_s + event.chance.lag_s),
        length_s_(event.end_s - starts_s_),
        late_s_(rendition_.Lateness() * length_s_) {
    vigour_ = VigourAfter(rendition_.style().person(), event.start_s);
  }

  /// How much of the body dances: 0 outside the event, 1 inside.
  double Weight(double time_s) const {
    const double since = time_s - starts_s_ - late_s_;
    const double inside =
        std::min(Smootherstep(1 + since / kBlendSeconds), Smootherstep(1 - (since - length_s_) / kBlendSeconds));
    return inside > 0 ? inside * rendition_.Presence(ShareAt(time_s)) : 0;
  }

  Controls At(double time_s) const { return rendition_.Danced(ShareAt(time_s), vigour_); }

  Stray Strays() const { return rendition_.Strays(); }
  /// When the performance gets to this beat of its move.
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

/// The person's ways with the moves that a plan names.
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

Performance Perform(RandomStream& random, std::span<const Move> moves, const Person& person, const SessionPlan& plan) {
  const auto styles = StylesFor(plan, moves, person);
  std::vector<Dance> dances;
  for (const SessionEvent& event : plan.events) {
    const Style* instead = event.danced.empty() ? nullptr : &styles.at(event.danced);
    dances.emplace_back(event, Rendition(styles.at(event.move), event.chance, event.faults, instead));
  }

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
  for (std::size_t i = 0; i < dances.size(); ++i) {
    SessionEvent& event = performance.events[i];
    event.stray = dances[i].Strays();
    event.truth = TruthOf(event.stray);
    if (event.IsRight()) event.first_right_s = dances[i].TimeOf(FindByName(moves, event.move)->key_poses.back().beat);
  }
  return performance;
}

}  // namespace etude
