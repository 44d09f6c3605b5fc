#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/motion/body.h"
#include "engine/retargeting/marker_sets.h"

namespace etude {

using MarkerPosition = std::optional<glm::dvec3>;
using JointPositions = std::array<MarkerPosition, kRoleCount>;

/// The positions of the wands in one frame, left, then right. A wand is a marker beside a thigh or shank that shows the
/// plane in which the limb bends.
struct Wands {
  std::array<MarkerPosition, 2> thigh = {}, shank = {};
};

/// Moves joints from their markers on the skin to the joints' centres (Davis et al. 1991, as in Vicon's Plug-in Gait;
/// the shares of limb lengths below are ours):
/// - knee and ankle: in the plane of the limb's wand or, without one, in the plane in which the limb bends. The centre
///   lies inward of the marker. The lines from the centre to the marker and to the limb's other end are perpendicular;
/// - elbow: along its hinge's axis, from the outside inward. If the lengths of the upper arms are far more constant
///   when the markers are assumed to be on the points of the elbows, the centre is put in front of the marker;
/// - shoulder: below its marker, along the trunk.
/// The distance from marker to centre is half the joint's width, or the whole shoulder offset, plus the marker's
/// radius. These sizes come from `sizes_m`, the file's own sizes: "LKNEEWIDTH", "RANKLEWIDTH", "LELBOWWIDTH",
/// "RSHOULDEROFFSET", "MARKERDIAMETER" (otherwise 14 mm). Without a size, the distance is a share of a limb's length:
/// 12 % of the thigh for the knee, 8.5 % of the shank for the ankle, and 13.5 % of the upper arm (between its markers)
/// for elbow and shoulder. Joints with an outer and an inner marker stay (LiesUnderSkin). In a frame that lacks a
/// joint of the same limb, knee, ankle and elbow cannot be moved and are removed, unless that is so in every frame.
/// `frames` are in metres, with shoulders, elbows, wrists, knees and ankles at their markers; `wands` has as many
/// frames. Returns a sentence about the moved joints, or "".
std::string MoveToJointCentres(const MarkerSet& set, const std::map<std::string, double>& sizes_m,
                               const std::vector<Wands>& wands, std::vector<JointPositions>& frames);

}  // namespace etude
