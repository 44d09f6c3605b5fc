#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/names.h"
#include "engine/base/result.h"
#include "engine/formats/trc.h"
#include "engine/motion/body.h"
#include "engine/motion/raw_motion.h"
#include "engine/retargeting/up_axis.h"

namespace etude {

/// Properties of a marker file that the user or the file states.
struct MarkerOptions {
  UpRule up = {};
  bool keep_floor = false;                                ///< true: the file's floor is not moved to 0
  std::optional<double> metres_per_unit = std::nullopt;  ///< given by the user; replaces the file's unit
  std::string set = "";                                  ///< a key of MarkerSets; "" = chosen by rank
  std::map<Role, std::string> roles = {};                ///< the markers that play roles, as given by the user
  std::string layout = "";    ///< the layout that names the joints of an array; "": the file itself names its markers
  bool is_of_camera = false;  ///< true: the array was rotated from a camera's frame
  bool keeps_shown = false;                              ///< true: MarkerBody::shown is filled
  bool keeps_others = false;                             ///< true: MarkerBody::others is filled
};

/// Consecutive frames of a file in which a body has all needed joints.
struct BodyStretch {
  std::size_t first_frame = 0;  ///< the file's index of the first frame
  std::vector<BodyPose> poses;
};

/// A body found in the trajectories of markers.
struct MarkerBody {
  std::string name;   ///< the text that the body's markers share ("Derrick" of "Derrick:LANK"), or ""
  BodyMotion motion;  ///< at the file's rate; metres, Y up, feet on the floor
  UpFinding up;       ///< the axis of the file that became the motion's Y axis
  /// By Index(role): the file's names of the markers that determine the joint; empty if it is placed by rule.
  std::array<std::vector<std::string>, kRoleCount> markers = {};
  double floor = 0;   ///< the height of the floor in the file, metres; in `motion` this height is 0
  bool is_floor_known = true;   ///< false: height 0 of the file is the camera's or the hips', not that of a floor
  std::size_t first_frame = 0;  ///< the file's index of the first kept frame
  /// The shorter stretches without a gap of over a second, in order of time, in the coordinates of `motion`. Empty
  /// unless MarkerOptions::keeps_others is set.
  std::vector<BodyStretch> others = {};
  /// The name of the marker set, then a text for users about each correction of the file's data.
  std::vector<std::string> changes;
  std::vector<std::string> doubts = {};  ///< the entries of `changes` that state what looks wrong in the file
  /// The markers exactly as the file shows them, in all its frames: gaps are not filled, no joint is placed by a rule,
  /// and the floor is not moved. First come the person's markers under their own names without prefix. The joints that
  /// the set computes from several markers follow, named by role. Metres, Y up. RawMotion::notes names the set and the
  /// assumptions. There are no frames unless MarkerOptions::keeps_shown is set.
  RawMotion shown = {};

  /// Appends `text` to `doubts` and to `changes`, unless it is empty.
  void Doubt(const std::string& text) {
    if (text.empty()) return;
    doubts.push_back(text);
    changes.push_back(text);
  }

  /// Returns `changes` as one line, separated by semicolons.
  std::string Note() const { return Join(changes, "; "); }
};

/// Finds the bodies of a marker recording by the markers' names. Known sets: Etude's own joints, OpenPose's BODY_25,
/// COCO, HALPE_26, the bones of Motive and HumanIK, the augmented markers of OpenCap and Pose2Sim, Plug-in Gait; if
/// none is complete, skin markers such as Helen Hayes (SetOfSkinNames) or a naming scheme of skeletons. For each person
/// who has the markers that `options.roles` names, its rules replace the set's rules; without a known set, they are the
/// only rules. Case is ignored. FindMarkerPeople assigns the markers to people. Joint centres are found by these rules,
/// which are ours where no source is named:
/// - the mean of the markers on both sides of a joint, if a set has both;
/// - hips from the four markers of the pelvis (or its two front markers and one on the sacrum) by the regression of
///   Harrington et al. (2007);
/// - for single markers on the skin, the centre by MoveToJointCentres;
/// - joints missing from a set: hip centre and shoulder centre midway between left and right, the spine midway between
///   these centres, the head 0.3 trunk lengths beyond the shoulder centre, hands 0.7 forearm lengths beyond the wrist,
///   toes 16 cm ahead of the ankle and 4 cm below it.
/// Gaps of up to a second are interpolated linearly and counted. If there are longer gaps, only the longest stretch
/// without such a gap becomes the motion, and the note states this. Positions at 0, 0, 0 may count as gaps
/// (RepairMarkers). The note names joints that seem to be exchanged between left and right (FindExchangedJoints).
/// FindUp finds the up axis by the rule `options.up`. The floor (5th percentile of the lowest joint's height) becomes
/// 0. For Etude's own joints, Y is up, except in arrays of other layouts (`options.layout`) or of a camera's frame. If
/// joints have the names of Etude's own, the floor stays unless it is over half a metre from 0, or unknown because the
/// array is of a camera's frame or relative to the hips. If a person has several complete sets, ChooseSet chooses one
/// by rank, and the note names the best other set whose knee markers differ.
///
/// If a body is not 0.4 to 4 m tall (median), its unit is assumed to be wrong. The unit is then multiplied by the power
/// of ten that makes the body 1.2 to 2.3 m tall, and the note states this. A unit given in `options` is never changed.
///
/// Fails, naming `file`, if no set is complete in shoulders, elbows, wrists, hips, knees and ankles (the message lists
/// the missing joints of the best set), if a marker on the thigh is named as the hip (DescribeWandAsHip), or if no unit
/// gives a plausible size.
Result<std::vector<MarkerBody>> FindMarkerBodies(MarkerMotion markers, const std::string& file,
                                                 const MarkerOptions& options = {});

/// Returns, for users, which joints the nearest set lacks; "" if a person's markers are a complete set, so that
/// FindMarkerBodies finds a body or fails for another reason.
std::string DescribeUnknownMarkers(const MarkerMotion& markers, const MarkerOptions& options);

}  // namespace etude
