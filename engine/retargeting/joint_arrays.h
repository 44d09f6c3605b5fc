#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/formats/npz.h"
#include "engine/formats/trc.h"
#include "engine/motion/body.h"
#include "engine/motion/raw_motion.h"
#include "engine/retargeting/joint_layouts.h"
#include "engine/retargeting/orientation.h"
#include "engine/retargeting/skin_markers.h"

namespace etude {

/// Joints in an array of a known layout.
struct ArrayJoints {
  MarkerMotion motion;        ///< `remark` states layout, unit and a rotation
  std::string layout;         ///< the name of the layout
  bool is_of_camera = false;  ///< true: the array was rotated from a camera's frame
};
/// Converts an array T × J × 3 (frames, joints, X Y Z; NaN: not seen) to trajectories. The file states no frame rate,
/// so the rate is kJudgedRateHz. `layout` is one of JointLayoutNames(); without a `layout`, the layout with J joints is
/// taken. The unit is the metre, or the centimetre or millimetre if the extent of the joints in this unit is a person's
/// size. If no up axis is `told` and the body is upside down in three of four frames without standing on its hands, the
/// array is taken to be in a camera's frame (Y down, Z forwards) and is rotated by half a turn about X. Fails for other
/// shapes, a layout with another number of joints, 17 joints without a layout, a layout that does not fit if another
/// one does (FindBetterLayout), and positions beyond ±10⁹.
Result<ArrayJoints> JointsOfArray(const NumberArray& array, const std::optional<std::string>& layout,
                                  const std::string& file, std::optional<UpAxis> told = {});

/// Returns a remark if an array has only a few frames, and most joints jump from each frame to the next: the frames may
/// be several people in one picture. Otherwise returns "".
std::string DescribeFewFrames(const MarkerMotion& motion);

/// Returns the joints in SAM 3D Body's results: `pred_joint_coords` (frames × 127 × 3), otherwise `pred_keypoints_3d`
/// (frames × 70 × 3), in metres. The joints are translated by `pred_cam_t` (frames × 3) if that array exists, and
/// rotated from the camera's frame (y down, z forwards) to Y up, z backwards. Frames × 1 count as frames of one person.
/// The body is upright if the camera was level. `note` states this. Returns nullopt if neither array exists; fails for
/// other shapes.
Result<std::optional<NumberArray>> JointsOfSam(const Npz& arrays, const std::string& file, std::string& note);

/// Writes a body's motion as an .npz file. Its arrays are `names`, and in the order of `names`: `positions` (T × 20 ×
/// 3, metres, Y up), `translations` (T × 20 × 3) and `rotations` (T × 20 × 4, w x y z) relative to each joint's parent,
/// `offsets` (at rest, 20 × 3) and `parents` (−1 for the root); also `rate_hz`, `unit` and `up`. All rotations are the
/// identity in `rest`. If `start_s` is not 0, there are also `times`, which count from it.
std::string WriteBodyNpz(const BodyMotion& motion, const BodyPose& rest, double start_s = 0);

/// Returns true if the arrays hold positions of joints, as WriteBodyNpz writes them.
bool IsBodyNpz(const Npz& arrays);
/// Properties that the user states; they overrule the file.
struct ArrayOptions {
  std::optional<double> rate_hz = {}, metres_per_unit = {};
  std::optional<UpAxis> up = {};
};
/// Reads positions from arrays like those of WriteBodyNpz: any joints, with their names in `names` (without names, the
/// twenty roles); NaN where a joint was not seen. A joint named like a role plays that role, unless the names are those
/// of a data set (FindDataSet). A joint named pelvis or hips plays the hip centre if no other joint does. The file
/// states the rate (RateOfArrays) or the times of its frames in `times` or `timestamps` (also `time`, `t`, and with
/// `_s`), or both; if they differ, the times are used (LayOnClock). It also states `unit` (metres per unit, or a text
/// for ReadUnit; without it, the metre) and `up` ("z", otherwise Y, or as in JointsOfArray). Positions are converted to
/// metres with Y up. If the user does not state the unit and, in the file's unit, the joints extend over less than 0.3
/// m or more than 4 m in the median frame, the unit is taken to be the metre, centimetre or millimetre, whichever gives
/// a person's size, and `notes` states this. Positions that stand for gaps count as not seen (RepairMarkers). Fails for
/// a missing rate, unusable times (LayOnClock), a wrong number of names, values beyond ±10⁹, and joints that extend
/// over more than 4 m if none of these units gives a person's size; in a unit that the user states, over less than 0.1
/// m or more than 4 m.
Result<RawMotion> ReadRawNpz(const Npz& arrays, const std::string& file, const ArrayOptions& told = {});
/// Returns the twenty joints of a motion, whose joints may be in any order; nullopt if the motion has other joints or
/// gaps.
std::optional<BodyMotion> BodyOf(const RawMotion& motion);
/// Returns the positions of the joints that play a role, in every frame.
std::vector<JointPositions> RolesIn(const RawMotion& motion);
/// Returns the joints of a motion as markers with the joints' names; gaps stay gaps.
MarkerMotion MarkersOf(const RawMotion& motion);

}  // namespace etude
