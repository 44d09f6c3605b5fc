#pragma once

#include "engine/transitions/joins/join.h"

namespace etude {

/// The old motion fades into the new one over `blend_s`, by the weight 3t² − 2t³ (Kovar, Gleicher and Pighin 2002,
/// section 3.3). The old motion goes on as far as its clip does and then holds its last frame.
///
/// The hip centre goes straight from the one to the other and every limb turns the shortest way, so that limbs which
/// are equally long in both keep their lengths.
Blend Crossfade(const SeamMotions& motions, const JoinSettings& settings);

}  // namespace etude
