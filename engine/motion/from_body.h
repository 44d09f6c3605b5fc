#pragma once

#include <string>

#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// A skeleton of the twenty roles by name, metres, Y up, rooted at the hip centre, whose rest pose is `rest` with all
/// axes along the world's: what characters are bound to.
Skeleton BodySkeleton(const BodyPose& rest);

/// A motion as a clip of BodySkeleton(its first frame). Nothing turns: every joint has its own translation from its
/// parent, so that ComputeGlobals gives back every position exactly, also of a performer whose limbs stretch. Needs at
/// least one frame.
Clip ToClip(const BodyMotion& motion, std::string name);

}  // namespace etude
