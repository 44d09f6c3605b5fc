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
/// (R = R₁R₂R₃); position channels of any joint, which replace that joint's offset; joints without
/// channels; "End Site"s, which become joints named "<parent>_End" (a name of their own, which some
/// exporters write, is not kept); names with blanks and colons; any case of keywords, tabs, empty
/// lines, lines that end with LF, CR LF or CR, a missing last one, a byte order mark. A name that
/// stands a second time becomes "<name>#2", so that every joint can be told. A rate within 0.01 % of a
/// whole number is taken as that number: files print few digits of it (.0083333 means 120 Hz). One
/// frame more than announced is dropped: some exporters announce the number of their last frame
/// (Boxing_Toes of assimp's models). Where all OFFSETs are 0 and joints have positions, the first frame's places
/// are the rest pose. `remarks` is told of both, in plain words.
///
/// Refused, with line and column: whatever is not in the grammar, a second ROOT, a frame that is not
/// one line with a number for every channel, another number of frames than announced, no frames, frame
/// times outside 0.1 ms…10 s, nesting over 128, over 1,024 joints, names over 500 bytes, frames that would take over 1
/// GB (an hour of 25 joints at 120 Hz), told before any of them is read.
Result<Clip> ReadBvh(std::string_view bytes, const std::string& file, std::vector<std::string>* remarks = nullptr);

/// Writes a clip as BVH: the root and every joint that leaves its offset in some frame with three positions, every
/// joint with Z, X, Y rotations in degrees; six decimals. Every joint is where it is in the clip, in all frames and
/// at rest. What BVH cannot say is told in another way: WithoutScales, WithOneRoot, WithWorldAxesAtRest. A clip read
/// from BVH needs none of them and comes back to the printed precision. Joints are written depth first, whatever
/// their order in the clip; end sites that have children or move become joints; braces and control characters in
/// names become '_', doubled names are numbered as in reading. Needs at least one joint, and numbers within ±10⁹ (what
/// ReadBvh takes).
std::string WriteBvh(Clip clip);

}  // namespace etude
