#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/clip.h"

namespace etude {

/// Reads a Biovision Hierarchy file: the skeleton and its frames, in the file's own unit and axes.
/// `file` names it in complaints; the clip takes its name from it (without folder and extension).
///
/// Read: any order and mix of channels per joint, rotations multiplied in the order written
/// (R = R₁R₂R₃); position channels of any joint, which replace that joint's offset; "End Site"s,
/// which become joints named "<parent>_End"; any case of keywords, tabs, CRLF, a missing last newline.
/// A rate within 0.01 % of a whole number is taken as that number: files print few digits of it
/// (.0083333 means 120 Hz). One frame more than announced is dropped: some exporters announce the
/// number of their last frame (Boxing_Toes of assimp's models).
///
/// Refused, with line and column: whatever is not in the grammar, a second ROOT, a frame with too few
/// or too many numbers, another number of frames than announced, no frames, frame times outside
/// 0.1 ms…10 s, nesting over 128, over 1,024 joints, frames that would take over 200 MB.
Result<Clip> ReadBvh(std::string_view bytes, const std::string& file);

/// Writes a clip as BVH: root with three positions, every joint with Z, X, Y rotations in degrees, six
/// decimals; a joint that leaves its offset in some frame gets positions too. Joints are written
/// depth first, whatever their order in the clip. End sites that have children become joints.
/// Needs exactly one root and finite numbers.
std::string WriteBvh(const Clip& clip);

}  // namespace etude
