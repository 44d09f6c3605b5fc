#pragma once

#include "sim/camera/bayer.h"
#include "sim/camera/exposure.h"
#include "sim/camera/light.h"
#include "sim/camera/sensor_noise.h"
#include "sim/camera/vignette.h"
#include "sim/random/stream.h"

namespace etude {

/// All that stands between the light behind the lens and what the sensor tells of it: light × transmission × exposure,
/// noise, then the gains of the white balance.
struct Sensor {
  const Transmission* transmission = nullptr;  ///< of the light's size; none: all light passes
  Toning toning{};
  SensorNoise noise{};

  /// A chip for each colour. Each row throws for three colours a pixel.
  void ReadColours(RandomStream& random, LightImage& light) const;
  /// One chip under a Bayer filter; of the throws of ReadColours it uses those of the colours that are there.
  void ReadMosaic(const LightImage& light, RandomStream& random, Mosaic& out) const;
};

}  // namespace etude
