#pragma once

#include "engine/base/image.h"

namespace etude {

/// How far every pixel's centre lies from the border of the mask, in pixels of the mask: positive outside, negative
/// inside. The border runs half a pixel beyond the centres of set pixels, so |distance| ≥ 0.5. Exact (Euclidean), in
/// time linear in the pixels: P. Felzenszwalb and D. Huttenlocher, "Distance transforms of sampled functions", Theory
/// of Computing 8 (2012), section 2. Where the mask has no set (no unset) pixel, the distance is ±(width + height).
Image<float> SignedDistances(const Mask& mask);

}  // namespace etude
