#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/capture_body.h"
#include "engine/motion/body.h"

namespace etude {

/// Finds for each true pose the pose of a body whose joints come nearest to it: the smallest Σ |joint − true joint|²
/// that is found, its root free to move and to turn. What is left of that distance the body cannot express. A body
/// fitted to who moves has none left.
std::vector<TreeState> FindNearestPoses(const CaptureBody& body, std::span<const BodyPose> truth);

}  // namespace etude
