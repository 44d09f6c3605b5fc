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

/// The markers beside a limb that show its plane, in one frame: thighs and shanks, left then right.
struct Wands {
  std::array<MarkerPosition, 2> thigh = {}, shank = {};
};

/// Moves joints from their markers on the skin to the joint's centre (Davis et al. 1991, as in Vicon's Plug-in Gait; the
/// shares are ours):
/// - knee and ankle: in the plane of the limb's wand, else of its bending, so that the centre is seen from the marker at
///   a right angle to the limb, inward by half the joint's width and a marker's radius;
/// - elbow: along its hinge's axis, from the outside inward. If upper arms keep their length far better so, the marker
///   sits on the elbow's point instead, and the centre lies before it;
/// - shoulder: below its marker, along the trunk.
/// The distances are (width + marker diameter) / 2 by `sizes_m`, the file's own: "LKNEEWIDTH", "RANKLEWIDTH",
/// "LELBOWWIDTH", "RSHOULDEROFFSET", "MARKERDIAMETER" (else 14 mm); without them shares of the limb before the joint:
/// 12 % of the thigh, 8.5 % of the shank, 16 % of the upper arm, both at elbow and shoulder.
/// `frames` are in metres, with shoulders, elbows, wrists, knees and ankles at their markers; `wands` has as many
/// frames. Returns a sentence about what was moved, or "".
std::string MoveToJointCentres(const MarkerSet& set, const std::map<std::string, double>& sizes_m,
                               const std::vector<Wands>& wands, std::vector<JointPositions>& frames);

}  // namespace etude
