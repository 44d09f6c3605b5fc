#pragma once

#include "engine/motion/clip.h"

namespace etude {

/// A transform between two, `part` of the way from the first: the rotation along the shorter great arc (slerp), the
/// translation and the scale straight.
LocalTransform Between(const LocalTransform& from, const LocalTransform& to, double part);

/// The pose of a clip at `frame` counted from 0, also between frames, clamped to the clip: every joint's rotation
/// along the shorter great arc between the two frames around (slerp), translations and scales straight. Joints turn,
/// so a limb keeps its length in between; interpolated positions would shorten it. A whole number gives the frame as
/// it is. Needs at least one frame.
LocalPose SampleFrame(const Clip& clip, double frame);

}  // namespace etude
