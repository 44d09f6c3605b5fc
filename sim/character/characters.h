#pragma once

#include "engine/motion/character.h"

namespace etude {

/// The coach: a friendly low-poly toy bear (paper A, figure 16). Generated, bound to BodySkeleton(StandingPose()).
Character BearCharacter();

/// The learner: a plain mannequin, generated and bound likewise.
Character MannequinCharacter();

}  // namespace etude
