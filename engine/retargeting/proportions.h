#pragma once

#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "engine/motion/rest_body.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/to_body.h"

namespace etude {

/// Measures the performer of a clip at rest, in metres, Y up, facing +Z: the skeleton's own rest pose, of which all
/// joints are left out that never turn (by more than 0.02°) in the clip and so are part of what they hang on. Where a
/// clip moves a joint within its parent, it lies in the middle of where it was. Where a role does not hang on the hips,
/// as feet that a rig moves by themselves, the body is made of the roles alone (RestBodyOf). `body` is what
/// ToBodyMotion made of the clip.
RestBody MeasureBody(const Clip& clip, const JointMap& map, const BodyConversion& body);

/// Returns the motion as a body with the limb lengths of `body` would make it: every limb keeps its direction, the
/// hips' way and height are scaled by the length of the legs (the performer's usual one: measured limbs stretch), then
/// the legs reach for the toes' scaled places by two-bone inverse kinematics, so that standing feet stay (Gleicher 1998
/// keeps the same contacts). Feet on the floor stay on the floor; where a leg is too short for that, the hips sink.
/// `body` is any pose of the target, standing for its lengths.
BodyMotion Retarget(const BodyMotion& motion, const BodyPose& body);

}  // namespace etude
