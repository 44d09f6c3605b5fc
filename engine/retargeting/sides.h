#pragma once

#include <span>
#include <string>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/retargeting/joint_map.h"

namespace etude {

/// Checks that left is left throughout a motion (ours), and returns by how far its knees overstretch on the average,
/// radians; 0 unless by 3° and more. Refused, naming `file`: a left arm on the side of the right leg; feet that point
/// backwards, or, when `map` has composed them forward, arms that bend and reach backwards by a quarter of their length
/// or knees that stand out backwards: straight ones prove nothing. Depth sensors overstretch knees: that is believed up
/// to 35° (three frames of four) while the arms are before the body.
Result<double> CheckSides(std::span<const BodyPose> poses, const JointMap& map, const std::string& file);

}  // namespace etude
