#pragma once

#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "sim/random/stream.h"

namespace etude {

/// Makes a large library of few motions, as when many dancers perform them, each at a tempo and an amplitude of his
/// own, on either side of the body. `frames` frames in all; the last clip is cut off there. No frame is a copy of
/// another.
///
/// The seeds (at least one, of at least two frames each) take turns. Of every clip: the tempo wanders within it
/// (0.7…1.4 of the seed's); the limbs' turns away from the seed's mean pose, as seen from the body, are scaled, each
/// arm, each leg and the trunk by a factor of its own (0.6…1.3) that wanders too, and so is the hips' height; and half
/// of the clips are mirrored. Limbs keep their lengths; feet may slide and leave the floor: made for searching, not for
/// watching.
std::vector<BodyMotion> VariedLibrary(std::span<const BodyMotion> seeds, int frames, RandomStream& stream);

}  // namespace etude
