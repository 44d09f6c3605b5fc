#include "sim/performer/sway.h"

#include <cmath>

#include "engine/base/angles.h"

namespace etude {

Sway::Sway(RandomStream& random) {
  for (double& phase : phases_) phase = random.Uniform(0, 2 * kPi);
}

Controls Sway::At(double time_s) const {
  const auto wave = [&](std::size_t i, double period_s) { return std::sin(2 * kPi * time_s / period_s + phases_[i]); };
  const double weight = wave(0, 5.3), breath = wave(2, 3.4), arms = wave(4, 4.7);
  Controls sway;
  sway[MiddleControl::kHipsSide] = 0.018 * weight;
  sway[MiddleControl::kHipsAhead] = 0.008 * wave(1, 3.9);
  sway[MiddleControl::kTrunkSide] = Radians(1.5) * weight;
  sway[MiddleControl::kTrunkBend] = Radians(0.8) * breath;
  sway[MiddleControl::kNeckTurn] = Radians(6) * wave(3, 7.1);
  for (Side side : {Side::kLeft, Side::kRight}) {
    sway.Of(side, SideControl::kArmSide) = Radians(1) * breath;
    sway.Of(side, SideControl::kArmForward) = Radians(2) * arms;
  }
  return sway;
}

}  // namespace etude
