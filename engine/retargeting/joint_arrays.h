#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/npz.h"
#include "engine/formats/trc.h"
#include "engine/motion/body.h"

namespace etude {

/// The layouts of joints that arrays are told by: "etude" (20), "smpl" (22 or 24), "h36m" (17), "coco" (17), "body_25",
/// "halpe_26".
std::vector<std::string> JointLayoutNames();

/// Makes trajectories of an array T × J × 3 (frames, joints, X Y Z; NaN: not seen), at the judged rate: such a file
/// tells none. `layout` is one of JointLayoutNames(); without one it is that of as many joints. Metres, unless the
/// joints' spread is that of a person in centimetres or millimetres; `note` says which, and that the rate is assumed.
/// Refused: other shapes, a layout of another number of joints, 17 joints without a layout, places beyond ±10⁹.
Result<MarkerMotion> JointsOfArray(const NumberArray& array, const std::optional<std::string>& layout,
                                   const std::string& file, std::string& note);

/// Writes a body's motion as an .npz file, of arrays in the order of `names`: `positions` (T × 20 × 3, metres, Y up),
/// `translations` and `rotations` from each joint's parent (T × 20 × 3; T × 20 × 4, w x y z), `offsets` (at rest, 20 ×
/// 3), `parents` (−1 of the root), `rate_hz`, `unit` and `up`. `rest` is the pose in which nothing turns.
std::string WriteBodyNpz(const BodyMotion& motion, const BodyPose& rest);

/// Tells whether arrays are those of WriteBodyNpz.
bool IsBodyNpz(const Npz& arrays);
/// Reads the positions of such arrays. Refused: another number of joints than twenty, no rate, numbers that are none.
Result<BodyMotion> ReadBodyNpz(const Npz& arrays, const std::string& file);

}  // namespace etude
