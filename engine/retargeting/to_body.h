#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/names.h"
#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/motion/clip.h"
#include "engine/retargeting/joint_map.h"
#include "engine/retargeting/orientation.h"
#include "engine/retargeting/up_axis.h"

namespace etude {

/// The known properties of a file; all others are estimated.
struct BodyOptions {
  double rate_hz = kJudgedRateHz;
  std::optional<double> metres_per_unit = std::nullopt;
  bool states_metres = false;                        ///< true: the file or its format states that its unit is the metre
  std::optional<UpAxis> up = std::nullopt;           ///< given by the user; overrules everything else
  std::optional<UpRule> up_rule = std::nullopt;      ///< rule of the file or its format
  std::optional<UpFinding> found_up = std::nullopt;  ///< the result of FindGround, if the file has several clips
  bool keep_floor = false;                           ///< true: the file's floor is not moved to 0
  std::optional<double> floor = std::nullopt;    ///< the floor's height along the up axis, in the file's unit
  std::optional<double> stature = std::nullopt;  ///< stature in motion, in the file's unit (Ground::stature)
  bool drop_t_pose = true;  ///< true: a leading T-pose from which the motion jumps is dropped; false: doubted
};

/// A clip converted to the twenty joints: metres, Y up, feet on the floor.
struct BodyConversion {
  double metres_per_unit = 0;
  /// "centimetre", "CMU", …; "given" (by the user); "unknown": the body is scaled to a stature of 1.70 m; "scaled":
  /// the rest pose has a known unit, and the frames are scaled to the stature at rest.
  std::string unit;
  UpAxis up = UpAxis::kY;
  UpFinding found_up = {};         ///< the axis of the file that points up, and its evidence
  double floor = 0;                ///< height of the floor along the file's up axis, in the file's unit
  std::size_t dropped_frames = 0;  ///< length of a leading T-pose that was dropped, frames
  /// A text for users about each finding and each correction of the file's data: "1 unit = 5.64 cm (CMU)", "dropped a
  /// leading T-pose".
  std::vector<std::string> changes = {};
  std::vector<std::string> doubts = {};  ///< the entries of `changes` that state what looks wrong in the file
  BodyMotion motion;

  /// Appends `text` to `doubts` and to `changes`, unless it is empty.
  void Doubt(const std::string& text) {
    if (text.empty()) return;
    doubts.push_back(text);
    changes.push_back(text);
  }

  /// Returns `changes` as one line, joined by semicolons.
  std::string Note() const { return Join(changes, "; "); }
};

/// Converts a clip to a body's motion (steps without a named source are ours):
/// - Z-up files are rotated upright (FindUp).
/// - A leading T-pose is dropped if the body jumps away from it; CMU's converted files begin with one.
/// - The motion is resampled to `rate_hz` by interpolating rotations (SampleFrame); the first frame is unchanged.
/// - Unit: metre, foot, CMU (1/0.45 inch), inch, cm or mm, whichever gives a stature of 1.45 m to 2.1 m (for
///   millimetres, which depth sensors write, from 1.2 m). If none does (children, toys), a unit that the file
///   states is used from 0.4 to 3 m; otherwise the body is scaled to a stature of 1.70 m. The note states if the stated
///   unit is not used. The stature is the length from ankle over knee, hip, spine and neck to the head at rest,
///   divided by 0.92. If the median stature over the frames differs from that at rest by a factor of more than 1.25,
///   the median is used and the note states it. If no unit fits the median, the rest pose's unit is used, and the
///   frames are scaled to the stature at rest, positions included (if the joints themselves are scaled, use
///   UndoScales). The note also states a difference of more than 5 % between both statures, and a stature that changes
///   by a factor of more than 1.25 within the clip. Clips of one file share a unit: pass them FindGround's stature; the
///   note states if a clip's own median differs by a factor of more than 1.25.
/// - Floor: the 5th percentile, over the frames, of the lowest joint's height (finger tips excluded) becomes y = 0.
///   Horizontal position and heading stay as in the file. Clips of one file share a floor: pass them the floor of
///   FindGround. If this floor is farther than a leg's length from the floor that the clip's own frames give, the clip
///   has another root and gets its own floor.
///
/// Fails, naming `file`, for: no frames; more than an hour or half a million poses; a body without size; two or more of
/// its eight limbs without length in the median frame; a body that is not 0.4 to 4 m tall in the unit that the user
/// gave. Also fails if left and right are swapped or the axes are left-handed: the left arm is on the side of the right
/// leg, or feet point backwards (if feet are composed: arms point backwards, or knees bend backwards by more than 35°
/// or together with the arms). The note states a smaller overextension of the knees.
Result<BodyConversion> ToBodyMotion(const Clip& clip, const JointMap& map, const std::string& file,
                                    const BodyOptions& options = {});

/// The up axis of a file, the height of its floor, and the stature of its body.
struct Ground {
  UpAxis up = UpAxis::kY;
  double floor = 0;    ///< height of the floor along the up axis, in the file's unit
  double stature = 0;  ///< median over the frames, in the file's unit
  UpFinding found_up = {};
};

/// Finds the ground of all clips of one skeleton in one file. The rules of ToBodyMotion are applied to the frames of
/// all clips together. A person who sits in one clip and stands in another therefore has the same floor in both, and
/// all clips have the same unit. An up axis, a floor or a stature given in `options` is taken as it is. Returns nullopt
/// if no clip has a frame, or if a position is not finite.
std::optional<Ground> FindGround(std::span<const Clip> clips, const JointMap& map, const BodyOptions& options = {});

/// Removes from a file's frames the scales that its rest pose does not have, such as a scale of the hips. The scales
/// are removed only if the body at rest has a person's size in some unit, and if the scales alone make the body in the
/// frames taller or smaller by a factor of more than 1.25 (median over the frames of all clips). Returns that factor;
/// nullopt if the clips are unchanged.
std::optional<double> UndoScales(std::span<Clip> clips, const JointMap& map);

/// Returns the transform from the file's unit and axes to the world of ToBodyMotion's result. Apply it to the clip's
/// meshes.
glm::dmat4 WorldFromFile(const BodyConversion& body);

/// Describes a change of the rate for users; "" if both rates are printed alike.
std::string DescribeResampling(double from_hz, double to_hz);
/// Doubts a rate of at most 7.5 Hz; "" for higher rates.
std::string DescribeSlowRate(double rate_hz);

/// Returns the median stature over the poses, in their unit.
double MedianStature(std::span<const BodyPose> poses);

/// Returns a message for the user if no person is as tall as this body in its median frame (under 0.5 m or over 2.75
/// m), or if the body is under 0.85 m tall and has an adult's long legs; otherwise "".
std::string DescribeImpossibleHeight(std::span<const BodyPose> poses);
/// Describes, for users, the unit in which a body is as tall as a person, if this is not the stated unit; otherwise "".
/// `stature` is in metres, by the stated unit.
std::string DescribeLikelyUnit(double stature, double metres_per_unit);

/// Returns true if the body stands with straight legs and both arms stretched out sideways.
bool IsTPose(const BodyPose& pose);

}  // namespace etude
