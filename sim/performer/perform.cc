#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/smoothstep.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/stance.h"
#include "sim/performer/session.h"

namespace etude {
namespace {

/// How long the way from the ready stance into a move takes, and back.
constexpr double kBlendSeconds = 0.45;

/// One learner's constant ways: how much further or less far each joint goes, and where it rests.
struct Habit {
  std::array<double, kControlCount> gains{};
  Controls offsets;
  std::array<double, 5> phases{};  // of the idle sway
};

Habit DrawHabit(RandomStream& random, double looseness) {
  const auto bounded = [&] { return looseness * std::clamp(random.Normal(), -2.0, 2.0); };
  Habit habit;
  for (double& gain : habit.gains) gain = 1 + 0.02 * bounded();
  constexpr double kRestDeviation = Radians(1.5);
  for (Side side : {Side::kLeft, Side::kRight}) {
    habit.offsets.Of(side, SideControl::kArmForward) = kRestDeviation * bounded();
    habit.offsets.Of(side, SideControl::kArmSide) = kRestDeviation * bounded();
  }
  habit.offsets[MiddleControl::kTrunkBend] = kRestDeviation * bounded();
  habit.offsets[MiddleControl::kTrunkTurn] = kRestDeviation * bounded();
  for (double& phase : habit.phases) phase = random.Uniform(0, 2 * kPi);
  return habit;
}

/// Nobody stands like a post: weight wanders from foot to foot, the chest breathes, the head looks about.
Controls Idle(const Habit& habit, double time) {
  const auto wave = [&](std::size_t i, double period_s) {
    return std::sin(2 * kPi * time / period_s + habit.phases[i]);
  };
  Controls controls = ReadyStance();
  controls[MiddleControl::kHipsSide] += 0.018 * wave(0, 5.3);
  controls[MiddleControl::kHipsAhead] += 0.008 * wave(1, 3.9);
  controls[MiddleControl::kTrunkSide] += Radians(1.5) * wave(0, 5.3);
  controls[MiddleControl::kTrunkBend] += Radians(0.8) * wave(2, 3.4);
  controls[MiddleControl::kNeckTurn] += Radians(6) * wave(3, 7.1);
  for (Side side : {Side::kLeft, Side::kRight}) {
    controls.Of(side, SideControl::kArmSide) += Radians(1) * wave(2, 3.4);
    controls.Of(side, SideControl::kArmForward) += Radians(2) * wave(4, 4.7);
  }
  return controls;
}

/// A performance's clock, seconds: runs with time between 0 and `length`, gathers way in the blend
/// before, and comes to rest in the blend after, so that nothing starts or stops at a jerk.
double EasedTime(double time, double length) {
  if (time < 0) {
    const double t = std::max(time, -kBlendSeconds) + kBlendSeconds;
    return 0.5 * t * t / kBlendSeconds - 0.5 * kBlendSeconds;
  }
  if (time > length) return length - EasedTime(length - time, length);
  return time;
}

/// One event, ready to be danced.
class Dance {
 public:
  Dance(const SessionEvent& event, const Move& move, const Habit& habit)
      : event_(event), move_(move), habit_(habit), length_s_(event.end_s - event.start_s) {}

  /// How much of the body dances: 0 outside the event, 1 inside.
  double Weight(double time) const {
    const double since = time - Start();
    return std::min(Smootherstep(1 + since / kBlendSeconds), Smootherstep(1 - (since - length_s_) / kBlendSeconds));
  }

  Controls At(double time) const {
    const double beat = EasedTime(time - Start(), length_s_) * move_.beats / length_s_;
    const Controls ready = ReadyStance(), authored = move_.curves.At(beat);
    Controls danced;
    for (std::size_t i = 0; i < kControlCount; ++i) {
      const double own = Amplitude() * habit_.gains[i];
      danced.values[i] = ready.values[i] + own * (authored.values[i] - ready.values[i]) + habit_.offsets.values[i];
    }
    for (Side side : {Side::kLeft, Side::kRight}) {
      danced.Of(side, SideControl::kLegFree) = authored.Of(side, SideControl::kLegFree);
      danced.Of(side, SideControl::kElbow) = std::max(0.0, danced.Of(side, SideControl::kElbow));
    }
    return Has(Fault::kWrongSide) ? Mirrored(danced) : danced;
  }

 private:
  bool Has(Fault fault) const {
    return std::ranges::find(event_.faults, fault, &GradedFault::fault) != event_.faults.end();
  }
  double Amplitude() const { return Has(Fault::kAmplitude) ? 0.5 : 1; }
  double Start() const { return event_.start_s; }

  const SessionEvent& event_;
  const Move& move_;
  const Habit& habit_;
  double length_s_;
};

const Move& FindMove(std::span<const Move> moves, const std::string& name) {
  const auto found = std::ranges::find(moves, name, &Move::name);
  assert(found != moves.end());
  return *found;
}

BodyPose PoseAt(double time, const Habit& habit, std::span<const Dance> dances) {
  Controls controls = Idle(habit, time);
  for (const Dance& dance : dances) {
    const double weight = dance.Weight(time);
    if (weight > 0) controls = Mix(controls, dance.At(time), weight);
  }
  return PoseOf(controls);
}

}  // namespace

Performance Perform(RandomStream& random, std::span<const Move> moves, const Person& person, const SessionPlan& plan) {
  const Habit habit = DrawHabit(random, 1);
  std::vector<Dance> dances;
  for (const SessionEvent& event : plan.events) {
    if (!event.danced.empty()) dances.emplace_back(event, FindMove(moves, event.danced), habit);
  }

  Performance performance{.person = person, .motion = {}, .events = plan.events};
  const auto frames = static_cast<std::size_t>(std::ceil(plan.duration_s * kJudgedRateHz));
  for (std::size_t frame = 0; frame < frames; ++frame) {
    performance.motion.poses.push_back(PoseAt(static_cast<double>(frame) / kJudgedRateHz, habit, dances));
  }
  for (SessionEvent& event : performance.events) {
    if (!event.faults.empty()) {
      event.truth = Truth::kWrong;
      continue;
    }
    const Move& move = FindMove(moves, event.move);
    event.first_right_s = event.start_s + (event.end_s - event.start_s) * move.key_poses.back().beat / move.beats;
  }
  return performance;
}

}  // namespace etude
