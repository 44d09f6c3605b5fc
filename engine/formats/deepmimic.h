#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/clip.h"

namespace etude {

/// Says whether a text begins like a motion of DeepMimic: JSON with "Frames" among its first keys.
bool IsDeepMimicMotion(std::string_view text);

/// Reads a motion of DeepMimic's humanoid3d (Peng et al. 2018, data/motions/humanoid3d_*.txt): metres, Y up, facing +X.
/// Every frame has 44 numbers: its duration in seconds, the root's place, and rotations in their parents' axes,
/// quaternions w x y z of root, chest, neck, hips, ankles and shoulders, angles about Z of knees and elbows, the right
/// side first. The files leave the skeleton to a file of its own; it is always the same one, and known here: limbs,
/// head and toes from data/characters/humanoid3d.txt.
///
/// Refused, naming the place: text over 64 MiB or no JSON, no frames, another count of numbers (as other characters
/// have), numbers beyond ±10⁹, quaternions of no length, frames of several durations (the last one's does not count).
Result<Clip> ReadDeepMimicMotion(std::string_view text, const std::string& file);

}  // namespace etude
