#pragma once

#include "sim/camera/light.h"

namespace etude {

/// What one chip under a Bayer filter tells: in each pixel one colour only, red where row and column are even, blue
/// where both are odd, green elsewhere.
using Mosaic = Image<float>;

/// Which of r, g, b a pixel of the mosaic holds: 0, 1, 2.
constexpr int BayerColour(int x, int y) { return (x & 1) + (y & 1); }

/// The two colours that each pixel lacks are the mean of the nearest two or four that have them: bilinear demosaicing,
/// the baseline that better ones are compared with. Beyond an edge the mosaic is mirrored. At least 2 × 2 pixels.
/// @param out of the mosaic's size
void Demosaic(const Mosaic& mosaic, LightImage& out);

}  // namespace etude
