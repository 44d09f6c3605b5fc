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

/// The exposure of a picture and the gains of the picture's three colours.
struct Toning {
  float exposure = 1;                  ///< factor on the light that falls on the sensor
  float red = 1, green = 1, blue = 1;  ///< factors on the values that the sensor reads
  friend bool operator==(const Toning&, const Toning&) = default;
};

/// An automatic exposure and an automatic white balance with errors. Exposure and white balance oscillate slowly about
/// their settings, with different periods of 4 to 10 seconds.
class AutomaticToning {
 public:
  AutomaticToning(const CameraEffects& effects, RandomStream& exposure, RandomStream& white_balance);
  /// Returns the toning at a time, where each sine is one of the slow oscillations: exposure = 2^(ev + drift · sin);
  /// red / blue = 2^(balance + drift · sin); green is 1.
  Toning At(double seconds) const;

 private:
  struct Swing {
    double period_s, phase;
    double At(double seconds) const;
  };
  static Swing DrawSwing(RandomStream& random);

  const CameraEffects effects_;
  const Swing exposure_, white_balance_;
};

/// Shot and read noise of a sensor in linear light v (1 = a full pixel at this gain):
///
///     variance = read² + photon² · v
///
/// The noise is independent between pixels and colours.
struct SensorNoise {
  float read = 0;
  float photon = 0;
  bool IsNone() const { return read == 0 && photon == 0; }
};

/// Returns the noise of an indoor webcam whose pixels hold 3000 electrons, with a read noise of 3 electrons *(ours)*.
/// In an 8-bit picture, the standard deviation is about 3 codes in the dark, 2.4 at mid-grey and 2 in the light.
/// `strength` multiplies it. With a gain of `gain_db`, proportionally fewer electrons fill a pixel.
SensorNoise WebcamNoise(double strength, double gain_db);

/// Draws standard normal numbers from a table of 1024 equally likely quantiles (at most 3.3 deviations from the mean),
/// six numbers per word of 64 random bits. A call for `count` numbers uses ⌈count / 6⌉ words.
class NormalRows {
 public:
  explicit NormalRows(RandomStream& random) : random_(random) {}
  /// Returns `count` numbers, valid until the next call.
  const float* Next(std::size_t count);
  /// Returns the next `count` numbers as indices of the table.
  const std::uint16_t* NextIndices(std::size_t count);
  /// Returns the table of numbers.
  static const float* Table();

 private:
  RandomStream& random_;
  std::vector<std::uint64_t> bits_;
  std::vector<std::uint16_t> indices_;
  std::vector<float> normals_;
};

/// Returns `light` with noise, at most 1 (a full pixel). `normal` is a standard normal number.
inline float Disturbed(const SensorNoise& noise, float light, float normal) {
  const float deviation = std::sqrt(noise.read * noise.read + noise.photon * noise.photon * (light > 0 ? light : 0));
  const float seen = light + deviation * normal;
  return seen < 1 ? seen : 1;
}

/// Adds noise to pictures that have no other effect. For every code, a table holds the 1024 outcomes of decoding the
/// code to light, adding noise and encoding the sum. The result has the same bytes as computing these steps for each
/// pixel, at a lower cost.
class CodeNoise {
 public:
  explicit CodeNoise(const SensorNoise& noise);
  /// Adds noise to a picture in place.
  void Apply(RandomStream& random, ColourImage& picture) const;

 private:
  /// The pixel value with noise, by [value without noise][index in NormalRows::Table()].
  std::vector<std::uint8_t> outcomes_;
};

/// The reading of a chip under a Bayer filter: each pixel has one colour, red where row and column are even, blue where
/// both are odd, green elsewhere.
using Mosaic = Image<float>;

/// Returns the colour (0, 1, 2 for r, g, b) that a pixel of the mosaic holds.
constexpr int BayerColour(int x, int y) { return (x & 1) + (y & 1); }

/// Interpolates the two missing colours of each pixel: each is the mean of the two or four nearest pixels that sense
/// this colour. This bilinear demosaicing is the usual baseline. The mosaic must have at least 2 × 2 pixels; it is
/// mirrored at its edges.
/// @param out must have the mosaic's size
void Demosaic(const Mosaic& mosaic, LightImage& out);

/// A model of the sensor. Its values are (light behind the lens × transmission × exposure + noise) × gains of the white
/// balance.
struct Sensor {
  const Transmission* transmission = nullptr;  ///< of the size of the LightImage; null: all light passes
  Toning toning{};
  SensorNoise noise{};

  /// Reads the light with one chip per colour, in place. For each pixel of a row, three random numbers are drawn.
  void ReadColours(RandomStream& random, LightImage& light) const;
  /// Reads the light with one chip under a Bayer filter. The same random numbers as in ReadColours are drawn; each
  /// pixel uses the number of its colour.
  void ReadMosaic(const LightImage& light, RandomStream& random, Mosaic& out) const;
};

}  // namespace etude
