#pragma once

#include "engine/motion/clip.h"

namespace etude {

/// The pose of a clip at `seconds` after its first frame, clamped to the clip: every joint's rotation
/// along the shorter great arc between the two frames around (slerp), translations straight. Joints
/// turn, so a limb keeps its length in between; interpolated positions would shorten it.
/// Needs at least one frame.
LocalPose SampleClip(const Clip& clip, double seconds);

}  // namespace etude
