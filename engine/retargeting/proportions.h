#pragma once

#include "engine/motion/body.h"

namespace etude {

/// Returns the motion as a body with the limb lengths of `body` would make it: every limb keeps its direction, the
/// hips' way and height are scaled by the length of the legs (the performer's usual one: measured limbs stretch), then
/// the legs reach for the toes' scaled places by two-bone inverse kinematics, so that standing feet stay (Gleicher 1998
/// keeps the same contacts). Feet on the floor stay on the floor; where a leg is too short for that, the hips sink.
/// `body` is any pose of the target, standing for its lengths.
BodyMotion Retarget(const BodyMotion& motion, const BodyPose& body);

}  // namespace etude
