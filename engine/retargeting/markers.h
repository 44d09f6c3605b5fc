#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/trc.h"
#include "engine/motion/body.h"

namespace etude {

/// A body found in the trajectories of markers.
struct MarkerBody {
  std::string name;   ///< the prefix of its markers ("Derrick" of "Derrick:LANK"), or ""
  BodyMotion motion;  ///< at the file's rate; metres, Y up, feet on the floor
  std::string note;   ///< the marker set and the corrections made, for people
  /// The joints as the markers show them, in all frames of the file and with its gaps: no gap is filled, no joint placed
  /// by rule, no floor found. First the joints that the set determines, by the names of their roles, then the person's
  /// other markers, by their own in lower case. Metres, Y up. Its remark names the set, and what was guessed.
  MarkerMotion shown = {};
};

/// Finds the bodies of a marker recording by the markers' names. Known sets: Etude's own joints, OpenPose's BODY_25,
/// COCO, HALPE_26, the bones of Motive and HumanIK, the augmented markers of OpenCap and Pose2Sim, Plug-in Gait. Case
/// and the text before the last ':' are ignored; each such prefix is one person. Joint centres (ours where no source is
/// given):
/// - the mean of the markers on both sides of a joint, if a set has both;
/// - hips from the four markers of the pelvis by the regression of Harrington et al. (2007);
/// - for Plug-in Gait, knees and ankles 5 and 3.5 cm inward from their single marker, perpendicular to the limb;
///   shoulders 4.5 cm below theirs, along the trunk; elbows at the marker;
/// - joints missing from a set: hip and shoulder centre midway between the joints, the spine midway between both, the
///   head 0.3 trunk lengths above, hands 0.7 forearm lengths beyond the wrist, toes 16 cm ahead of the ankle and 4 cm
///   below.
/// Gaps of up to a second are interpolated linearly and counted. With longer gaps, only the longest stretch without one
/// is kept, and the note states it. Positions at 0, 0, 0 count as gaps if the marker is elsewhere in other frames. `up`
/// is 'Y', 'Z', or 0: then it is the axis along which shoulders are farthest from ankles.
///
/// If a body is not 0.4 to 4 m tall (median), its unit is assumed to be wrong: the power of ten that makes it 1.2 to
/// 2.3 m tall is applied, and the note states it.
///
/// Fails, naming `file`, if no set is complete in shoulders, elbows, wrists, hips, knees and ankles (the message lists
/// what the best set lacks), or if no unit gives a plausible size.
Result<std::vector<MarkerBody>> FindMarkerBodies(MarkerMotion markers, const std::string& file, char up = 0);

}  // namespace etude
