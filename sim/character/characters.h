#pragma once

#include "engine/motion/character.h"

namespace etude {

/// Generates the coach, a friendly low-poly toy bear (paper A, figure 16), bound to BodySkeleton(StandingPose()).
Character BearCharacter();

/// Generates the learner, a plain mannequin, bound to the skeleton of the bear.
Character MannequinCharacter();

}  // namespace etude
