#pragma once

#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "engine/motion/rest_body.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/to_body.h"

namespace etude {

/// Measures the resting body of a clip's performer. The body is in metres, Y up, and faces +Z. It is the skeleton's
/// own rest pose; joints that rotate by less than 0.02° in the clip are merged into their parents. A joint that the
/// clip translates relative to its parent is put at its mean position. If a role does not descend from the hips (feet
/// with separate controls), the body consists of the roles only (RestBodyOf). `body` must be the result of
/// ToBodyMotion for the clip.
RestBody MeasureBody(const Clip& clip, const JointMap& map, const BodyConversion& body);

/// Transfers a motion to a body with the limb lengths of `body`: every limb keeps its direction, and the hip centre's
/// path and height are scaled by the ratio of the two bodies' leg lengths. (The performer's leg length is a median,
/// because measured lengths vary.) Two-bone inverse kinematics then brings the toes to their scaled positions, so
/// standing feet do not slide (Gleicher 1998 keeps the same contacts). Feet on the floor stay there; if a leg is too
/// short, the hips are lowered. `body` may be any pose of the target; only its lengths are used.
BodyMotion Retarget(const BodyMotion& motion, const BodyPose& body);

}  // namespace etude
