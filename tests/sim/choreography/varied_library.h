#pragma once

#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "sim/random/stream.h"

namespace etude {

/// Makes a large library from few motions, as if many dancers performed them, each with an individual tempo and
/// amplitude, some mirrored. The library has `frames` frames in total; the last clip is cut off there. No frame is a
/// copy of another.
///
/// Clips are made from the seeds in turn (at least one seed, each of at least two frames). In every clip the tempo
/// varies (0.7 to 1.4 times the seed's). In the body's frame, rotations of limbs away from the seed's mean pose are
/// scaled: each arm, each leg and the trunk by its own varying factor (0.6 to 1.3); the hips' height is also scaled.
/// Half of the clips are mirrored. Limbs keep their lengths. Feet may slide and leave the floor, because the library is
/// meant for searches and not for watching.
std::vector<BodyMotion> VariedLibrary(std::span<const BodyMotion> seeds, int frames, RandomStream& stream);

}  // namespace etude
