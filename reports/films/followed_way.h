#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "engine/motion/body.h"

namespace etude {

/// What a camera follows, for every frame: the way of the hips, averaged over `smoothing` frames to either side. It
/// stands still, which is calmer, when the whole motion stays within 45 cm of its middle. Needs at least one frame.
std::vector<glm::dvec3> FollowedWay(const BodyMotion& motion, int smoothing);

}  // namespace etude
