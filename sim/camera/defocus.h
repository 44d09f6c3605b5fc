#pragma once

#include <vector>

#include "sim/camera/light.h"

namespace etude {

/// Spreads every point to a Gaussian of standard deviation `sigma_px`, cut off beyond three of them; what lies outside
/// is taken to be like the nearest pixel. A lens out of focus spreads a point to a disc, but its aberrations and the
/// sensor's pixels round that off; MTF(f) = exp(−2π²σ²f²), f in cycles per pixel. Not deeper or shallower with
/// distance.
class Defocus {
 public:
  explicit Defocus(double sigma_px);
  void Apply(LightImage& light);

 private:
  void BlurAcross(const Light* row, std::size_t width, Light* out);

  std::vector<float> weights_;  ///< of the middle, and of those 1, 2, … away
  std::vector<Light> padded_row_, across_;
  std::vector<const float*> rows_;
};

}  // namespace etude
