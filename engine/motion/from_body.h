#pragma once

#include <string>

#include "engine/motion/body.h"
#include "engine/motion/clip.h"

namespace etude {

/// A motion as a clip of a skeleton of the twenty roles, metres, Y up, rooted at the hip centre. Nothing turns: every
/// joint has its own translation from its parent, so that ComputeGlobals gives back every position exactly, also of
/// a performer whose limbs stretch. Needs at least one frame; the rest pose is the first.
Clip ToClip(const BodyMotion& motion, std::string name);

}  // namespace etude
