#include "sim/camera/exposure.h"

#include <cmath>

#include "engine/base/angles.h"

namespace etude {

double AutomaticToning::Swing::At(double seconds) const { return std::sin(2 * kPi * seconds / period_s + phase); }

AutomaticToning::Swing AutomaticToning::ThrowSwing(RandomStream& random) {
  const double period_s = random.Uniform(4, 10);
  return {period_s, random.Uniform(0, 2 * kPi)};
}

AutomaticToning::AutomaticToning(const CameraEffects& effects, RandomStream& exposure, RandomStream& white_balance)
    : effects_(effects), exposure_(ThrowSwing(exposure)), white_balance_(ThrowSwing(white_balance)) {}

Toning AutomaticToning::At(double seconds) const {
  const double stops = effects_.exposure_ev + effects_.exposure_drift_ev * exposure_.At(seconds);
  const double warmth = effects_.white_balance_ev + effects_.white_balance_drift_ev * white_balance_.At(seconds);
  return {.exposure = static_cast<float>(std::exp2(stops)),
          .red = static_cast<float>(std::exp2(warmth / 2)),
          .green = 1,
          .blue = static_cast<float>(std::exp2(-warmth / 2))};
}

}  // namespace etude
