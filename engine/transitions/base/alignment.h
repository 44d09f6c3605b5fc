#pragma once

#include "engine/motion/body.h"

namespace etude {

/// The move on the floor (yaw, x, z) that lays `pose` onto `onto`: same heading, hip centres above
/// each other. Heights and limbs stay as they are.
FloorMove AlignOnFloor(const BodyPose& pose, const BodyPose& onto);

/// How far apart two poses are once facing and place on the floor are taken away: the distance of the
/// worst joint after `AlignOnFloor`, metres.
double PoseGap(const BodyPose& a, const BodyPose& b);

}  // namespace etude
