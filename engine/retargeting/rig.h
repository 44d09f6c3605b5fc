#pragma once

#include <string>

#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// A skeleton of the twenty roles by name, rooted at the hip centre, whose rest pose is `rest` with all axes along the
/// world's: what characters are bound to.
Skeleton BodySkeleton(const BodyPose& rest);

/// The local transforms that bring BodySkeleton(rest) into `pose`: each limb is turned from its rest direction by the
/// shortest way, then about itself so that hips, chest and head face as their neighbours do, and elbows and knees bend
/// about their hinge. Joints are where `pose` has them: a limb of another length than at rest shows in the
/// translations, nothing is scaled. Continuous where the pose is.
LocalPose PoseRig(const BodyPose& rest, const BodyPose& pose);

/// A motion as a clip of BodySkeleton(rest) with turning joints: what other programs expect of BVH and glTF.
Clip RigClip(const BodyMotion& motion, const BodyPose& rest, std::string name);

}  // namespace etude
