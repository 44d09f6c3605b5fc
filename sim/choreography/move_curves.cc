#include "sim/choreography/move_curves.h"

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

MoveCurves::MoveCurves(const std::vector<PoseKey>& keys, double beats, Style style) : style_(style) {
  curves_.reserve(kControlCount);
  for (std::size_t i = 0; i < kControlCount; ++i) {
    std::vector<PeriodicCurve::Key> values;
    for (const PoseKey& key : keys) values.push_back({key.beat, key.controls.values[i]});
    curves_.emplace_back(std::move(values), beats);
  }
}

Controls MoveCurves::At(double beat) const {
  Controls controls;
  for (std::size_t i = 0; i < kControlCount; ++i) {
    controls.values[i] = curves_[i].At(beat - style_.overlap_beats * kLateness[i]);
  }
  controls[MiddleControl::kHipsDrop] += style_.bounce * 0.5 * (1 + std::cos(2 * kPi * beat));
  return controls;
}

}  // namespace etude
