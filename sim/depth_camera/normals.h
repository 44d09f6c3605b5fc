#pragma once

#include <glm/glm.hpp>

#include "engine/base/image.h"
#include "engine/cameras/camera.h"

namespace etude {

/// Directions in the world, unit, out of the surface that a pixel shows; zero where nothing is seen.
using NormalImage = Image<glm::vec3>;

/// Computes the normals of surfaces seen at `depth` by `camera` (its lens included), from the points behind
/// neighbouring pixels: on each axis the neighbour whose depth is nearer, so that edges of things do not bend their
/// surfaces. A plane's are right to the depths' own rounding; a pixel between two edges has none of its own.
NormalImage NormalsOf(const DepthImage& depth, const Camera& camera);

}  // namespace etude
