#pragma once

#include <vector>

#include "sim/render/renderer.h"

namespace etude {

/// Pixels left ≤ x < right, top ≤ y < bottom.
struct PixelRect {
  int left = 0, top = 0, right = 0, bottom = 0;
  int Width() const { return right - left; }
  int Height() const { return bottom - top; }
  bool IsEmpty() const { return right <= left || bottom <= top; }
};

/// Rectangles of the picture outside which GL draws nothing: around every figure and, in the studio, the shadow of its
/// surfaces. They may overlap. All within `rows` of the picture.
std::vector<PixelRect> TouchedPixels(const Room& room, const std::vector<Figure>& figures, const Camera& camera,
                                     const RowRange& rows);

}  // namespace etude
