#include "sim/choreography/move_curves.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

/// How much of the overlap each control comes late: hips lead, hands and head follow. Feet keep time.
constexpr std::array<double, kControlCount> kLateness = [] {
  std::array<double, kControlCount> lateness{};
  const auto late = [&](SideControl control, double share) {
    for (Side side : {Side::kLeft, Side::kRight}) lateness[Controls::SideIndex(side, control)] = share;
  };
  late(SideControl::kArmForward, 0.4);
  late(SideControl::kArmSide, 0.4);
  late(SideControl::kArmTwist, 0.6);
  late(SideControl::kElbow, 0.8);
  late(SideControl::kWrist, 1.4);
  for (MiddleControl control : {MiddleControl::kTrunkBend, MiddleControl::kTrunkSide, MiddleControl::kTrunkTurn}) {
    lateness[static_cast<std::size_t>(control)] = 0.2;
  }
  for (MiddleControl control : {MiddleControl::kNeckBend, MiddleControl::kNeckSide, MiddleControl::kNeckTurn}) {
    lateness[static_cast<std::size_t>(control)] = 1.0;
  }
  return lateness;
}();

}  // namespace

MoveCurves::MoveCurves(const std::vector<PoseKey>& authored, double beats, Style style)
    : style_(style), last_beat_(authored.back().beat) {
  std::vector<PoseKey> keys = authored;
  if (!style.loops) {
    // A closed curve that rests in the last pose, and again in the first one, comes to a stop in both; nobody sees
    // its way back.
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
    controls.values[i] = curves_[i].At(seen(beat - style_.overlap_beats * kLateness[i]));
  }
  controls[MiddleControl::kHipsDrop] += style_.bounce * 0.5 * (1 + std::cos(2 * kPi * seen(beat)));
  return controls;
}

}  // namespace etude
