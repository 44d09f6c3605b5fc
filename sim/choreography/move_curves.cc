#include "sim/choreography/move_curves.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

/// Returns the slope at a key by Fritsch and Butland's formula, from the intervals before and after the key (widths h,
/// secant slopes d).
double MonotoneSlope(double h_before, double d_before, double h_after, double d_after) {
  if (d_before * d_after <= 0) return 0;
  const double w_before = 2 * h_after + h_before, w_after = h_after + 2 * h_before;
  return (w_before + w_after) / (w_before / d_before + w_after / d_after);
}

double SmallerOfSameSign(double a, double b) {
  if (a * b <= 0) return 0;
  return std::abs(a) < std::abs(b) ? a : b;
}

/// Returns true if a motion with this ease (timing) starts and ends at rest.
bool IsBetweenRests(Ease ease) { return ease == Ease::kSnap || ease == Ease::kStep; }

/// Returns the curve's parameter after a share of a segment's time. Unless the curve rests at both ends, the first two
/// derivatives at the ends must equal the derivatives of the identity.
double Eased(Ease ease, double share) {
  // The bulge moves the motion away from the identity. The bulge and its first two derivatives are zero at both ends of
  // a segment. The sums of share and bulge below increase everywhere while kStrength is below 18.6.
  constexpr double kStrength = 8;
  const double hump = share * (1 - share), bulge = kStrength * hump * hump * hump;
  const auto within = [share](double from, double to) { return std::clamp((share - from) / (to - from), 0.0, 1.0); };
  switch (ease) {
    case Ease::kSmooth:
      return share;
    case Ease::kLinger:
      return share + bulge;
    case Ease::kRush:
      return share - bulge;
    case Ease::kSnap:
      return within(0.5, 1);
    case Ease::kStep:
      return within(0.2, 0.84);
  }
  return share;
}

using Keys = std::vector<PeriodicCurve::Key>;

constexpr double kStandardGravity = 9.80665;  // m/s²

/// The controls that determine the place of a standing foot on the floor.
constexpr SideControl kSpot[] = {SideControl::kFootSide, SideControl::kFootAhead, SideControl::kFootTurn};

bool IsOneOf(std::size_t control, std::span<const SideControl> of) {
  return std::ranges::any_of(of, [control](SideControl wanted) {
    return control == Controls::SideIndex(Side::kLeft, wanted) || control == Controls::SideIndex(Side::kRight, wanted);
  });
}

/// Returns true if the foot must be lifted between one pose and the next.
bool Steps(const Controls& from, const Controls& to, Side side) {
  if (from[MiddleControl::kJump] > 0 || to[MiddleControl::kJump] > 0) return false;
  for (SideControl off_the_floor : {SideControl::kFootLift, SideControl::kLegFree}) {
    if (from.Of(side, off_the_floor) > 0 || to.Of(side, off_the_floor) > 0) return false;
  }
  return std::ranges::any_of(kSpot, [&](SideControl spot) { return from.Of(side, spot) != to.Of(side, spot); });
}

/// Returns the keys of the foot's height: the authored keys, and one lifted key half way through every step.
Keys LiftKeys(const std::vector<PoseKey>& poses, double beats, Side side) {
  constexpr double kStepHeight = 0.05;
  Keys keys;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool wraps = i + 1 == poses.size();
    const PoseKey &from = poses[i], &to = poses[wraps ? 0 : i + 1];
    keys.push_back({from.beat, from.controls.Of(side, SideControl::kFootLift), from.ease});
    if (!Steps(from.controls, to.controls, side)) continue;
    const double middle = 0.5 * (from.beat + to.beat + (wraps ? beats : 0));
    keys.insert(middle < beats ? keys.end() : keys.begin(), {std::fmod(middle, beats), kStepHeight});
  }
  return keys;
}

double JumpOf(const PoseKey& pose) { return pose.controls[MiddleControl::kJump]; }

/// The durations of a jump, in beats. The body is in the air for `flight` before and after the top. The knees push off
/// from `effort` before the top, and absorb the landing until `effort` after it.
struct JumpTimes {
  double flight, effort;
};

JumpTimes TimesOf(const PoseKey& top, double beat_seconds) {
  constexpr double kEffort = 2.5;  // `effort` / `flight`; push-off and landing each last 1.5 `flight`
  const double flight = std::sqrt(2 * JumpOf(top) / kStandardGravity) / beat_seconds;
  return {flight, kEffort * flight};
}

Keys JumpKeys(const std::vector<PoseKey>& poses, double beat_seconds) {
  const double gravity = kStandardGravity * beat_seconds * beat_seconds;  // metres per square beat
  const auto belongs_to_a_jump = [&](double beat) {
    return std::ranges::any_of(poses, [&](const PoseKey& top) {
      return JumpOf(top) > 0 && std::abs(beat - top.beat) <= TimesOf(top, beat_seconds).effort;
    });
  };
  Keys keys;
  for (const PoseKey& pose : poses) {
    if (JumpOf(pose) > 0) {
      const auto [flight, effort] = TimesOf(pose, beat_seconds);
      const double speed = gravity * flight;
      keys.push_back({pose.beat - effort, 0});
      // The quintics through these three keys are exactly the parabola of the flight.
      keys.push_back({pose.beat - flight, 0, Ease::kSmooth, {{speed, -gravity}}});
      keys.push_back({pose.beat, JumpOf(pose), Ease::kSmooth, {{0, -gravity}}});
      keys.push_back({pose.beat + flight, 0, Ease::kSmooth, {{-speed, -gravity}}});
      keys.push_back({pose.beat + effort, 0});
    } else if (!belongs_to_a_jump(pose.beat)) {
      keys.push_back({pose.beat, JumpOf(pose)});
    }
  }
  return keys;
}

/// The delay of each control, as a share of the overlap: hips lead, hands and head follow, feet are on time.
constexpr std::array<double, kControlCount> kDelay = [] {
  std::array<double, kControlCount> delay{};
  const auto late = [&](SideControl control, double share) {
    for (Side side : {Side::kLeft, Side::kRight}) delay[Controls::SideIndex(side, control)] = share;
  };
  late(SideControl::kArmForward, 0.4);
  late(SideControl::kArmSide, 0.4);
  late(SideControl::kArmTwist, 0.6);
  late(SideControl::kElbow, 0.8);
  late(SideControl::kWrist, 1.4);
  for (MiddleControl control : {MiddleControl::kTrunkBend, MiddleControl::kTrunkSide, MiddleControl::kTrunkTurn}) {
    delay[static_cast<std::size_t>(control)] = 0.2;
  }
  for (MiddleControl control : {MiddleControl::kNeckBend, MiddleControl::kNeckSide, MiddleControl::kNeckTurn}) {
    delay[static_cast<std::size_t>(control)] = 1.0;
  }
  return delay;
}();

}  // namespace

PeriodicCurve::PeriodicCurve(std::vector<Key> keys, double period) : period_(period) {
  assert(!keys.empty() && period > 0);
  const std::size_t count = keys.size();
  const auto width = [&](std::size_t i) {
    return i + 1 < count ? keys[i + 1].at - keys[i].at : keys[0].at + period - keys[i].at;
  };
  const auto secant = [&](std::size_t i) { return (keys[(i + 1) % count].value - keys[i].value) / width(i); };
  const auto rests = [&](std::size_t i) {
    return IsBetweenRests(keys[i].ease) || IsBetweenRests(keys[(i + 1) % count].ease);
  };

  // Compute the slope of every knot.
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count;
    double slope = rests(i) ? 0 : MonotoneSlope(width(before), secant(before), width(i), secant(i));
    if (keys[i].derivatives) slope = keys[i].derivatives->slope;
    knots_.push_back({keys[i].at, keys[i].value, slope, 0, keys[i].ease});
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count, after = (i + 1) % count;
    // For the two cubic Hermite segments that meet at this key, compute the second derivatives at the key.
    const double ending = (2 * knots_[before].slope + 4 * knots_[i].slope - 6 * secant(before)) / width(before);
    const double starting = (6 * secant(i) - 4 * knots_[i].slope - 2 * knots_[after].slope) / width(i);
    knots_[i].bend = rests(i) ? 0 : SmallerOfSameSign(ending, starting);
    if (keys[i].derivatives) knots_[i].bend = keys[i].derivatives->bend;
  }
  knots_.push_back(knots_.front());
  knots_.back().at += period;
}

double PeriodicCurve::At(double time) const {
  // Find the segment that contains the time, modulo the period.
  const double first = knots_.front().at;
  double at = first + std::fmod(time - first, period_);
  if (at < first) at += period_;
  const auto after = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, at,
                                      [](double value, const Knot& knot) { return value < knot.at; });
  const Knot& from = *(after - 1);
  const Knot& to = *after;

  // Evaluate the quintic Hermite segment: the Taylor parabola at the segment's start, plus a correction that fits the
  // segment's end.
  const double h = to.at - from.at, s = Eased(to.ease, (at - from.at) / h);
  const double slope = from.slope * h, bend = from.bend * h * h;
  const double gap = to.value - from.value - slope - 0.5 * bend;
  const double slope_gap = to.slope * h - slope - bend;
  const double bend_gap = to.bend * h * h - bend;
  const double c3 = 10 * gap - 4 * slope_gap + 0.5 * bend_gap;
  const double c4 = -15 * gap + 7 * slope_gap - bend_gap;
  const double c5 = 6 * gap - 3 * slope_gap + 0.5 * bend_gap;
  return from.value + s * (slope + s * (0.5 * bend + s * (c3 + s * (c4 + s * c5))));
}

std::vector<PeriodicCurve::Key> KeysOf(const std::vector<PoseKey>& poses, std::size_t control, double beats,
                                       double beat_seconds) {
  if (control == static_cast<std::size_t>(MiddleControl::kJump)) return JumpKeys(poses, beat_seconds);
  for (Side side : {Side::kLeft, Side::kRight}) {
    if (control == Controls::SideIndex(side, SideControl::kFootLift)) return LiftKeys(poses, beats, side);
  }
  constexpr SideControl kLegFree[] = {SideControl::kLegFree};
  const bool is_spot = IsOneOf(control, kSpot), is_leg_free = IsOneOf(control, kLegFree);
  Keys keys;
  for (const PoseKey& pose : poses) {
    const double value = pose.controls.values[control];
    Ease ease = pose.ease;
    if (is_spot) ease = Ease::kStep;
    // The leg becomes free before its angles raise the foot, and stands again only after they have lowered the foot.
    if (is_leg_free) ease = value > 0 ? Ease::kLinger : Ease::kRush;
    keys.push_back({pose.beat, value, ease});
  }
  return keys;
}

Result<void> CheckJumps(const std::vector<PoseKey>& poses, double beats, double beat_seconds, const Place& place) {
  double caught = 0;
  for (const PoseKey& top : poses) {
    if (JumpOf(top) <= 0) continue;
    const double effort = TimesOf(top, beat_seconds).effort;
    if (top.beat - effort <= caught || top.beat + effort >= beats) {
      return Fail(place,
                  "the jump at beat {:.4g} would last from beat {:.2f} to beat {:.2f}; allowed: a jump between beats "
                  "{:.2f} and {:.4g}",
                  top.beat, top.beat - effort, top.beat + effort, caught, beats);
    }
    caught = top.beat + effort;
  }
  return {};
}

MoveCurves::MoveCurves(const std::vector<PoseKey>& authored, double beats, Style style)
    : style_(style), last_beat_(authored.back().beat) {
  std::vector<PoseKey> keys = authored;
  if (!style.loops) {
    // Add a key in the last pose and a key in the first pose. Between equal neighbouring keys the curve is constant, so
    // it rests after the last pose and before the first one. The part between the two added keys is never sampled.
    keys.push_back({last_beat_ + 1, keys.back().controls});
    keys.push_back({last_beat_ + 2, keys.front().controls});
    beats = last_beat_ + 3;
  }
  curves_.reserve(kControlCount);
  for (std::size_t i = 0; i < kControlCount; ++i) {
    curves_.emplace_back(KeysOf(keys, i, beats, style.beat_seconds), beats);
  }
}

MoveCurves MoveCurves::Through(std::span<const Controls> bodies, double beats) {
  MoveCurves curves;
  for (std::size_t i = 0; i < kControlCount; ++i) {
    std::vector<PeriodicCurve::Key> keys;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      keys.push_back({beats * static_cast<double>(k) / static_cast<double>(bodies.size()), bodies[k].values[i]});
    }
    curves.curves_.emplace_back(std::move(keys), beats);
  }
  return curves;
}

Controls MoveCurves::At(double beat) const {
  const auto seen = [&](double at) { return style_.loops ? at : std::clamp(at, 0.0, last_beat_); };
  Controls controls;
  for (std::size_t i = 0; i < kControlCount; ++i) {
    controls.values[i] = curves_[i].At(seen(beat - style_.overlap_beats * kDelay[i]));
  }
  controls[MiddleControl::kHipsDrop] += style_.bounce * 0.5 * (1 + std::cos(2 * kPi * seen(beat)));
  return controls;
}

}  // namespace etude
