#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/base/image.h"
#include "sim/camera/camera_effects.h"
#include "sim/camera/lens.h"
#include "sim/camera/light.h"
#include "sim/random/stream.h"

namespace etude {

/// The exposure of a picture and the gains of its three colours.
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
  /// Returns the toning at a time: exposure = 2^(ev + drift · sin); red / blue = 2^(balance + drift · sin), green is
  /// left alone.
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

/// Returns the noise of an indoor webcam with pixels of 3000 electrons, read with an error of 3: about 3 counts of an
/// 8-bit picture in the dark, 2.4 at mid-grey, 2 in the light (ours). `strength` multiplies deviations. Amplified by
/// `gain_db`, a pixel is full with so many fewer electrons.
SensorNoise WebcamNoise(double strength, double gain_db);

/// Standard normal numbers, six out of each draw: a table of 1024 equally likely quantiles (nothing beyond 3.3
/// deviations). Each row of a picture takes ⌈count / 6⌉ draws.
class NormalRows {
 public:
  explicit NormalRows(RandomStream& random) : random_(random) {}
  /// Returns `count` numbers, valid until the next call.
  const float* Next(std::size_t count);
  /// Returns the numbers as places in the table.
  const std::uint16_t* NextPlaces(std::size_t count);
  /// Returns the table of numbers by place.
  static const float* Table();

 private:
  RandomStream& random_;
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint16_t> places_;
  std::vector<float> normals_;
};

/// Returns the noisy value of light v for a standard normal number; a full pixel takes no more light.
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

/// The picture of one chip under a Bayer filter: each pixel has one colour only, red where row and column are even,
/// blue where both are odd, green elsewhere.
using Mosaic = Image<float>;

/// Returns which of r, g, b a pixel of the mosaic holds: 0, 1 or 2.
constexpr int BayerColour(int x, int y) { return (x & 1) + (y & 1); }

/// Interpolates the two colours that each pixel lacks, as the mean of the nearest two or four that have them: bilinear
/// demosaicing, the baseline that better ones are compared with. Beyond an edge the mosaic is mirrored. At least 2 × 2
/// pixels.
/// @param out of the mosaic's size
void Demosaic(const Mosaic& mosaic, LightImage& out);

/// The sensor, from the light behind the lens to the values that it reads: light × transmission × exposure, noise, then
/// the gains of the white balance.
struct Sensor {
  const Transmission* transmission = nullptr;  ///< of the light's size; none: all light passes
  Toning toning{};
  SensorNoise noise{};

  /// Reads the light with a chip for each colour. Each row throws for three colours a pixel.
  void ReadColours(RandomStream& random, LightImage& light) const;
  /// Reads the light with one chip under a Bayer filter; of the throws of ReadColours it uses those of the colours that
  /// are there.
  void ReadMosaic(const LightImage& light, RandomStream& random, Mosaic& out) const;
};

}  // namespace etude
