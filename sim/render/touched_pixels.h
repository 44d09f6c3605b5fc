#pragma once

#include <vector>

#include "engine/cameras/camera.h"
#include "sim/render/scene.h"

namespace etude {

/// Returns the rectangles of the picture in which GL draws: around every figure and, in the studio, around the shadows
/// that the figure's surfaces cast on the floor and, if `with_wall`, on the wall. The rectangles may overlap; all lie
/// within `rows` of the picture.
std::vector<PixelRect> TouchedPixels(const Room& room, const std::vector<Figure>& figures, const Camera& camera,
                                     const RowRange& rows, bool with_wall = true);

}  // namespace etude
