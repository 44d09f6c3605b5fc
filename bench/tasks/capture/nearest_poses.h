#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/capture_body.h"
#include "engine/motion/body.h"

namespace etude {

/// Finds for each true pose the pose of a body whose joints come nearest to it: the smallest Σ |joint − true joint|²
/// found, with a root that moves and turns freely. The remaining distance cannot be expressed by the body. A body
/// fitted to the performer has none.
std::vector<TreeState> FindNearestPoses(const CaptureBody& body, std::span<const BodyPose> truth);

}  // namespace etude
