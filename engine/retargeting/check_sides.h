#pragma once

#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/retargeting/joint_map.h"

namespace etude {

/// Whether left is left throughout a motion, in the body's own frame, so that it may lie or turn over (ours). Refused,
/// naming `file`: a left arm on the side of the right leg; feet that point backwards, or, when `map` has composed
/// them forward, knees that stand out backwards. Straight knees prove nothing and pass.
Result<void> CheckSides(std::span<const BodyPose> poses, const JointMap& map, const std::string& file);

}  // namespace etude
