#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/capture_body.h"
#include "engine/motion/body.h"

namespace etude {

/// Finds for each true pose the pose of a body whose joints come nearest to it: the pose with the smallest Σ |joint −
/// true joint|² that was found; the root moves and turns freely. The remaining distance is what this body cannot
/// express; for a body fitted to the performer it is zero.
std::vector<TreeState> FindNearestPoses(const CaptureBody& body, std::span<const BodyPose> truth);

}  // namespace etude
