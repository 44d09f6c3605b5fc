#pragma once

#include "engine/motion/body.h"

namespace etude {

/// Returns the move on the floor (yaw, x, z) that lays `pose` onto `onto`: same heading, hip centres above each other.
/// Heights and limbs stay as they are.
FloorMove AlignOnFloor(const BodyPose& pose, const BodyPose& onto);

/// Returns the distance of two poses once facing and place on the floor are taken away: that of the worst joint after
/// `AlignOnFloor`, metres.
double PoseGap(const BodyPose& a, const BodyPose& b);

}  // namespace etude
