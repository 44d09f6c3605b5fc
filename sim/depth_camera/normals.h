#pragma once

#include <glm/glm.hpp>

#include "engine/base/image.h"
#include "engine/cameras/camera.h"

namespace etude {

/// Unit normals in the world that point out of the surface at each pixel; zero where there is no surface.
using NormalImage = Image<glm::vec3>;

/// Computes the normals of the surfaces in `depth`, as seen by `camera` (lens included), from the points of
/// neighbouring pixels. On each axis it uses the neighbour of more similar depth, so that the edges of objects do not
/// distort their surfaces. For a plane the normals are exact up to the rounding of depths; a pixel between two edges
/// has no normal.
NormalImage NormalsOf(const DepthImage& depth, const Camera& camera);

}  // namespace etude
