#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/motion/clip.h"

namespace etude {

/// Reads a Biovision Hierarchy file: the skeleton and its frames, in the file's own unit and axes. `file` is the file's
/// name for error messages; without folder and extension it becomes the clip's name.
///
/// Accepted:
/// - any order and mix of channels per joint, with rotations multiplied in the order written (R = R₁R₂R₃);
/// - position channels of any joint, which replace that joint's OFFSET;
/// - joints without channels;
/// - "End Site"s, which become joints named "<parent>_End" (names that some exporters give them are ignored);
/// - names with spaces and colons, keywords in any case, tabs, empty lines, line ends LF, CR LF or CR, a missing last
///   line end, a byte order mark. A name that occurs again becomes "<name>#2", so that joints can be distinguished. A
///   rate within 0.01 % of a whole number is rounded to it, because files print few digits (.0083333 means 120 Hz).
///
/// `remarks` receives a sentence about each of these cases:
/// - If the file has one frame more than announced, that frame is dropped, because some exporters announce the number
///   of their last frame (as in assimp's model Boxing_Toes).
/// - If a joint below the root has position channels and an OFFSET of 0, its position in the first frame becomes its
///   rest position.
/// - If the positions of most joints with an OFFSET stay near 0, positions are relative to the OFFSETs, so the OFFSETs
///   are added.
/// - If the frame time has so few digits that the period of a usual rate, rounded or cut off, has the same (0.033 s may
///   be 30 Hz), the stated time is taken, unless the caller states the rate as `told_hz`.
/// - If no joint rotates by more than 6.28 degrees, the file's angles may be radians.
///
/// Returns an error with line and column for anything outside the grammar, a second ROOT, a frame that is not one line
/// with one number per channel, a wrong number of frames, no frames, frame times outside 0.1 ms…10 s, nesting deeper
/// than 128 levels, more than 1,024 joints, names longer than 500 bytes, and, before any frame is read, frames that
/// would take more than 1 GB (an hour of 25 joints at 120 Hz).
Result<Clip> ReadBvh(std::string_view bytes, const std::string& file, std::vector<std::string>* remarks = nullptr,
                     std::optional<double> told_hz = {});

/// Writes a clip as BVH. The root and every joint whose translation changes get three position channels, and an OFFSET
/// of 0: some readers replace OFFSET by the position, others add the two. Every joint gets Z, X, Y rotations in
/// degrees; numbers have six decimals. Every joint has the same position as in the clip, in all frames. When the file
/// is read again, a joint with position channels rests at its position in the first frame, and the root rests at the
/// origin. Scales, several roots and rotated axes at rest, which BVH cannot express, are first removed by
/// WithoutScales, WithOneRoot and WithWorldAxesAtRest. Frames that were read from BVH need no conversion and are
/// reproduced to the printed precision. Joints are written depth first, regardless of their order in the clip. End
/// sites that have children or move become joints. Braces and control characters in names become '_', and duplicate
/// names are numbered as in reading. The clip must have at least one joint and numbers within ±10⁹ (the limit of
/// ReadBvh).
std::string WriteBvh(Clip clip);

}  // namespace etude
