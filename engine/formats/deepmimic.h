#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/clip.h"

namespace etude {

/// Returns true if a text begins like a motion of DeepMimic: JSON with "Frames" among its first keys.
bool IsDeepMimicMotion(std::string_view text);

/// Reads a motion of DeepMimic's humanoid3d (Peng et al. 2018, data/motions/humanoid3d_*.txt) in metres, Y up, facing
/// +X. Every frame has 44 numbers: its duration in seconds, the root's position, and the joints' rotations relative to
/// their parents. Knees and elbows have an angle about Z in radians; root, chest, neck, hips, ankles and shoulders have
/// a quaternion w x y z. The limbs of the right side come before those of the left. The files do not contain the
/// skeleton. It is the same for all files and is built in, with the numbers of data/characters/humanoid3d.txt.
///
/// Returns an error with the position for text over 64 MiB or without valid JSON, no frames, a number of values other
/// than 44 (as for other characters), numbers beyond ±10⁹, quaternions of length 0, and frames of different durations
/// (the last frame's duration is ignored).
Result<Clip> ReadDeepMimicMotion(std::string_view text, const std::string& file);

}  // namespace etude
