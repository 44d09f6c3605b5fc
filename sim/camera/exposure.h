#pragma once

#include "sim/camera/camera_effects.h"
#include "sim/random/stream.h"

namespace etude {

/// How much a camera takes of the light, and what it makes of the three colours.
struct Toning {
  float exposure = 1;                  ///< times the light that falls on the sensor
  float red = 1, green = 1, blue = 1;  ///< times what the sensor tells
  friend bool operator==(const Toning&, const Toning&) = default;
};

/// An automatic exposure and white balance that are never quite right: each wanders slowly and regularly about its
/// setting, 4 to 10 seconds to and fro, by throws of their own.
class AutomaticToning {
 public:
  AutomaticToning(const CameraEffects& effects, RandomStream& exposure, RandomStream& white_balance);
  /// exposure = 2^(ev + drift · sin); red / blue = 2^(balance + drift · sin), green is left alone.
  Toning At(double seconds) const;

 private:
  struct Swing {
    double period_s, phase;
    double At(double seconds) const;
  };
  static Swing ThrowSwing(RandomStream& random);

  const CameraEffects effects_;
  const Swing exposure_, white_balance_;
};

}  // namespace etude
