#pragma once

#include "engine/base/image.h"
#include "engine/cameras/camera.h"

namespace etude {

/// The share of the light that reaches a pixel, 0…1.
using Transmission = Image<float>;

/// Darkens towards the corners: cos(θ) to the power 4 · strength, θ between the pixel's ray and the axis. 1 is what
/// geometry alone does to a lens; mounts and filters add to it.
void AddVignette(const Camera& camera, double strength, Transmission& transmission);

}  // namespace etude
