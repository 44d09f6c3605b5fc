#pragma once

#include <string>

#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"

namespace etude {

/// Returns a message for the user if the root's positions seem to have another unit than the limbs; otherwise "". For
/// example, positions in metres and limbs in centimetres need the factor 100. With the right factor, one ankle hardly
/// moves in the median frame, because one foot stands; this ankle must be far slower than with factor 1 (ours). A
/// factor below 1 is reported only if the speed in the file is impossible.
std::string DescribeRootTravel(const Clip& clip, const JointMap& map);

}  // namespace etude
