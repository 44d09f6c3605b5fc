#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/npz.h"
#include "engine/formats/trc.h"
#include "engine/motion/body.h"
#include "engine/motion/raw_motion.h"
#include "engine/retargeting/joint_layouts.h"
#include "engine/retargeting/orientation.h"

namespace etude {

/// Converts an array T × J × 3 (frames, joints, X Y Z; NaN: not seen) to trajectories. Their rate is the judged rate,
/// because such a file contains none. Unless the up axis is `told`, a body that stands on its head in three of four
/// frames, but not on its hands, is in a camera's frame (Y down, Z forwards), and is turned by half a turn about X.
/// `layout` is one of
/// JointLayoutNames(); without it, the layout is the one with J joints. The unit is the metre, unless the joints extend
/// as far as a person's in centimetres or millimetres. `note` states layout and unit. Fails for other shapes, a layout
/// with another number of joints, 17 joints without a layout, and positions beyond ±10⁹.
Result<MarkerMotion> JointsOfArray(const NumberArray& array, const std::optional<std::string>& layout,
                                   const std::string& file, std::string& note, std::optional<UpAxis> told = {});

/// Returns the joints in SAM 3D Body's results: `pred_joint_coords` (frames × 127 × 3) or else `pred_keypoints_3d`
/// (frames × 70 × 3), metres, moved by `pred_cam_t` (frames × 3) if that exists, and turned from the camera's frame (y
/// down, z forwards) to Y up, z backwards. The body is upright if the camera was level. Returns nothing if neither
/// array exists.
std::optional<NumberArray> JointsOfSam(const Npz& arrays);

/// Writes a body's motion as an .npz file with the arrays, in the order of `names`: `positions` (T × 20 × 3, metres, Y
/// up), `translations` and `rotations` relative to each joint's parent (T × 20 × 3; T × 20 × 4, w x y z), `offsets` (at
/// rest, 20 × 3), `parents` (−1 for the root), `rate_hz`, `unit` and `up`. All rotations are the identity in `rest`.
std::string WriteBodyNpz(const BodyMotion& motion, const BodyPose& rest);

/// Returns true if the arrays hold positions of joints, as those of WriteBodyNpz do.
bool IsBodyNpz(const Npz& arrays);
/// What the user states about arrays; it replaces what the file says.
struct ArrayOptions {
  std::optional<double> rate_hz = {}, metres_per_unit = {};
  std::optional<UpAxis> up = {};
};
/// Reads the positions of such arrays: any joints, with their names in `names` (the twenty without), a joint NaN where
/// it was not seen. A joint named like a role plays it, one named pelvis or hips the hip centre if no other does. The
/// file says `rate_hz`, `unit` ("cm" or metres; else metres) and `up` ("z"; else Y, or as in JointsOfArray); positions
/// become metres with Y up.
/// A unit that nobody told is wrong if the joints extend less than 0.3 m or more than 4 m in the median frame: metres,
/// centimetres or millimetres that make a person of them are taken, and `notes` says so. Positions that stand for gaps
/// (RepairMarkers) are not seen. Fails for a missing rate, another number of names, a size
/// of no unit, and values beyond ±10⁹.
Result<RawMotion> ReadRawNpz(const Npz& arrays, const std::string& file, const ArrayOptions& told = {});
/// Returns the twenty joints of a motion, which may stand in any order; nothing if it has others, or a gap.
std::optional<BodyMotion> BodyOf(const RawMotion& motion);
/// Returns the joints of a motion as markers of their names, with their gaps.
MarkerMotion MarkersOf(const RawMotion& motion);

}  // namespace etude
