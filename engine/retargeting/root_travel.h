#pragma once

#include <string>

#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"

namespace etude {

/// Says, for people, that a clip's root travels as its limbs do only if its positions are multiplied by a factor, such
/// as 100 for metres above limbs in centimetres; "" if no factor fits better. By the right factor, one ankle hardly
/// moves in the median frame, because a foot stands: by far less than as the file is (ours). A factor below 1 is said
/// only of a speed that is impossible.
std::string DescribeRootTravel(const Clip& clip, const JointMap& map);

}  // namespace etude
