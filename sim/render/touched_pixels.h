#pragma once

#include <vector>

#include "engine/cameras/camera.h"
#include "sim/render/scene.h"

namespace etude {

/// Rectangles of the picture outside which GL draws nothing: around every figure and, in the studio, the shadow of its
/// surfaces (`with_wall`: on the wall too). They may overlap. All within `rows` of the picture.
std::vector<PixelRect> TouchedPixels(const Room& room, const std::vector<Figure>& figures, const Camera& camera,
                                     const RowRange& rows, bool with_wall = true);

}  // namespace etude
