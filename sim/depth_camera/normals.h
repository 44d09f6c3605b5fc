#pragma once

#include <glm/glm.hpp>

#include "engine/base/image.h"
#include "engine/cameras/camera.h"

namespace etude {

/// Unit normals in the world that point out of the surface at each pixel; zero where there is no surface.
using NormalImage = Image<glm::vec3>;

/// Computes the normals of the surfaces in `depth`, as seen by `camera` (lens included), from the points of
/// neighbouring pixels. On each axis, the neighbour with the more similar depth is used, because normals must not mix
/// two surfaces at an edge. For a plane the normals are exact up to the rounding of depths. A pixel between two edges
/// has no normal.
NormalImage NormalsOf(const DepthImage& depth, const Camera& camera);

}  // namespace etude
