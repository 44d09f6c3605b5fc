#pragma once

#include "engine/motion/body.h"

namespace etude {

/// The motion as a body with the limb lengths of `body` would make it: every limb keeps its direction, the hips' way
/// and height are scaled by the length of the legs, then the legs reach for the feet's scaled places by two-bone
/// inverse kinematics, so that standing feet stay (Gleicher 1998 keeps the same contacts). Feet on the floor stay on
/// the floor. `body` is any pose of the target, standing for its lengths.
BodyMotion Retarget(const BodyMotion& motion, const BodyPose& body);

}  // namespace etude
