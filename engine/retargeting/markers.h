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
  std::string note;   ///< the marker set, and what was filled in, in plain words
};

/// Finds the bodies that markers show, by their names: Etude's own joints, OpenPose's BODY_25, COCO, HALPE_26, the
/// bones of Motive and HumanIK, the augmented markers of OpenCap and Pose2Sim, Plug-in Gait. Case, and what stands
/// before the last ':', do not count; each such prefix is a person. Joint centres (ours where no source is named):
/// - the middle of the markers on both sides of a joint, where a set has both;
/// - hips from the four markers of the pelvis by the regression of Harrington et al. (2007);
/// - of Plug-in Gait, knees and ankles 5 and 3.5 cm inward from their one marker, across the limb; shoulders 4.5 cm
/// below
///   theirs, down the trunk; elbows where the marker is;
/// - what a set lacks: hip and shoulder centre midway between the joints, the spine midway between both, the head .3
/// trunks
///   above, hands .7 forearms beyond the wrist, toes 16 cm before the ankle, level.
/// Gaps up to a second are bridged by straight lines, and counted; of longer ones the longest stretch without is kept,
/// and said; so are places at 0, 0, 0 of markers that are elsewhere in other frames. `up` is told or found: the axis
/// along which heads are furthest from ankles.
///
/// A body that is not 0.4 to 4 m tall (median) is told by a wrong unit: the power of ten that makes a person of it,
/// 1.2 to 2.3 m, is taken, and said.
///
/// Refused, naming `file`: no set whose shoulders, elbows, wrists, hips, knees and ankles are all there, with what the
/// nearest set lacks; a body of no such size.
Result<std::vector<MarkerBody>> FindMarkerBodies(MarkerMotion markers, const std::string& file, char up = 0);

}  // namespace etude
