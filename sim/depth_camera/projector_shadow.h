#pragma once

#include "engine/base/image.h"
#include "engine/cameras/camera.h"

namespace etude {

/// 1 where what `camera` sees gets no light from a projector `baseline_m` on its right (+x of the camera's frame, same
/// viewing direction): something nearer in the same row lies between. Left of an edge that is f · b · (1/z_near −
/// 1/z_far) pixels wide. Rows are taken as the planes of projector and camera, which a lens bends a little; what stands
/// outside the picture throws no shadow into it. None with `baseline_m` 0.
Mask ProjectorShadow(const DepthImage& depth, const Camera& camera, double baseline_m);

}  // namespace etude
