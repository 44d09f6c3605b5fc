#pragma once

#include "sim/render/touched_pixels.h"

namespace etude {

/// The same view with twice as many pixels a side.
Camera Doubled(const Camera& camera);

/// Each pixel of `small` that `rect` of `large` touches becomes the mean of its four there.
void AverageFours(const ColourImage& large, const PixelRect& rect, ColourImage& small);

}  // namespace etude
