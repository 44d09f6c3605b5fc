#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/capture_body.h"
#include "engine/motion/body.h"

namespace etude {

/// Fits a body to each true pose: minimises Σ |joint − true joint|² over the angles and over a root that moves and
/// turns freely. The minimum may be local. The remaining distance is the error that this body cannot avoid; it is zero
/// for a body that was fitted to the performer.
std::vector<TreeState> FindNearestPoses(const CaptureBody& body, std::span<const BodyPose> truth);

}  // namespace etude
