#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/base/image.h"
#include "sim/camera/light.h"
#include "sim/random/stream.h"

namespace etude {

/// Shot and read noise of a sensor, told in linear light v (1 = a full pixel at this gain):
///
///     variance = read² + photon² · v
///
/// Independent per pixel and colour.
struct SensorNoise {
  float read = 0;
  float photon = 0;
  bool IsNone() const { return read == 0 && photon == 0; }
};

/// An indoor webcam with pixels of 3000 electrons, read with an error of 3: about 3 counts of an 8-bit picture in the
/// dark, 2.4 at mid-grey, 2 in the light (ours). `strength` multiplies deviations. Amplified by `gain_db`, a pixel is
/// full with so many fewer electrons.
SensorNoise WebcamNoise(double strength, double gain_db);

/// Standard normal numbers, six out of each draw: a table of 1024 equally likely quantiles (nothing beyond 3.3
/// deviations). Each row of a picture takes ⌈count / 6⌉ draws.
class NormalRows {
 public:
  explicit NormalRows(RandomStream& random) : random_(random) {}
  /// `count` numbers; valid until the next call.
  const float* Next(std::size_t count);
  /// The same as places in the table.
  const std::uint16_t* NextPlaces(std::size_t count);
  /// The number at a place.
  static const float* Table();

 private:
  RandomStream& random_;
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint16_t> places_;
  std::vector<float> normals_;
};

/// What comes out for light v and a standard normal number: a full pixel takes no more light.
inline float Disturbed(const SensorNoise& noise, float light, float normal) {
  const float deviation = std::sqrt(noise.read * noise.read + noise.photon * noise.photon * (light > 0 ? light : 0));
  const float seen = light + deviation * normal;
  return seen < 1 ? seen : 1;
}

/// Noise for pictures that need nothing else, the same bytes as from light and faster: decoded, disturbed, encoded by
/// one table of every code's 1024 outcomes.
class CodeNoise {
 public:
  explicit CodeNoise(const SensorNoise& noise);
  void Apply(RandomStream& random, ColourImage& picture) const;

 private:
  std::vector<std::uint8_t> outcomes_;  ///< [code][place in the table of normals]
};

}  // namespace etude
