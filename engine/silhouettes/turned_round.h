#pragma once

#include "engine/kinematics/tree.h"
#include "engine/silhouettes/silhouette_body.h"

namespace etude {

/// The body the other way round *(ours)*: its left limbs where the right ones are in `state` and these where the left
/// ones are, as nearly as its joints allow; feet and head point where they then may. Its outlines are much the same.
TreeState TurnedRound(const SilhouetteBody& body, const TreeState& state);

}  // namespace etude
