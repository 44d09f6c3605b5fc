#pragma once

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

}  // namespace etude
