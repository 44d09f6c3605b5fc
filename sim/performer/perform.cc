#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/smoothstep.h"
#include "sim/choreography/canonical_body.h"
#include "sim/choreography/reach.h"
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
  /// `looseness` scales the learner's deviations from the move as taught, the fault aside.
  Dance(const SessionEvent& event, const Move& move, const Habit& habit, double looseness = 1)
      : event_(event),
        move_(move),
        habit_(habit),
        looseness_(looseness),
        length_s_(move.beats * 60 / (move.tempo_bpm * event.tempo)) {}

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
      const double own = event_.amplitude * habit_.gains[i];
      const double reach = event_.IsRight() ? 1 + looseness_ * (own - 1) : own;
      danced.values[i] =
          ready.values[i] + reach * (authored.values[i] - ready.values[i]) + looseness_ * habit_.offsets.values[i];
    }
    for (Side side : {Side::kLeft, Side::kRight}) {
      danced.Of(side, SideControl::kLegFree) = authored.Of(side, SideControl::kLegFree);
      danced.Of(side, SideControl::kElbow) = std::max(0.0, danced.Of(side, SideControl::kElbow));
    }
    return event_.fault == Fault::kWrongSide ? Mirrored(danced) : danced;
  }

 private:
  double Start() const { return event_.start_s + event_.delay_s; }

  const SessionEvent& event_;
  const Move& move_;
  const Habit& habit_;
  double looseness_;
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

/// Whether this dance alone passes through the key poses inside its event's window.
bool IsSeenRight(const Dance& dance, const SessionEvent& event, const Move& asked, const Habit& habit) {
  BodyMotion window;
  const auto first = static_cast<std::size_t>(std::ceil(event.start_s * kJudgedRateHz));
  const auto last = static_cast<std::size_t>(event.WindowEnd() * kJudgedRateHz);
  for (std::size_t frame = first; frame <= last; ++frame) {
    window.poses.push_back(PoseAt(static_cast<double>(frame) / kJudgedRateHz, habit, {&dance, 1}));
  }
  return FirstReached(asked.key_poses, window, 0, window.DurationSeconds()).has_value();
}

/// The event as this learner dances it. A right performance is right whatever the learner's habits:
/// they are halved, then dropped, where they would miss a key pose.
Dance MakeDance(const SessionEvent& event, const Move& danced, const Habit& habit) {
  for (double looseness : {1.0, 0.5}) {
    Dance dance(event, danced, habit, looseness);
    if (!event.IsRight() || IsSeenRight(dance, event, danced, habit)) return dance;
  }
  return Dance(event, danced, habit, 0);
}

}  // namespace

Performance Perform(RandomStream& random, std::span<const Move> moves, const SessionPlan& plan,
                    const SessionOptions& options) {
  const Habit habit = DrawHabit(random, 2 - std::clamp(options.skill, 0.0, 1.0));
  std::vector<Dance> dances;
  for (const SessionEvent& event : plan.events) {
    if (event.fault != Fault::kSkipped) dances.push_back(MakeDance(event, FindMove(moves, event.danced), habit));
  }

  Performance performance{.motion = {}, .events = plan.events};
  const auto frames = static_cast<std::size_t>(std::ceil(plan.duration_s * kJudgedRateHz));
  for (std::size_t frame = 0; frame < frames; ++frame) {
    performance.motion.poses.push_back(PoseAt(static_cast<double>(frame) / kJudgedRateHz, habit, dances));
  }
  for (SessionEvent& event : performance.events) {
    event.first_right_s =
        FirstReached(FindMove(moves, event.move).key_poses, performance.motion, event.start_s, event.WindowEnd());
  }
  return performance;
}

}  // namespace etude
