#pragma once

#include <optional>
#include <span>
#include <string>

#include "engine/formats/trc.h"
#include "engine/retargeting/marker_sets.h"

namespace etude {

/// Makes a marker set for one person if the names show that the markers lie on the skin: both front or both back spines
/// of the pelvis ("R.ASIS", "LPSI"), a marker on the inside of a knee, or markers on thigh, knee and shank of one leg.
/// The names are those of Motion Analysis' Helen Hayes set ("R.Thigh", "L_Knee", "right_asis"), OpenSim's models
/// ("R.Knee.Lat", "RLFC"), the Human Body Model ("LLEK") and the anatomical landmarks of RRIS40 ("RFLE"). Sides are
/// written as for skeletons (JointNames). A joint is the mean of its outer and inner markers; without an inner marker
/// it lies under its outer one. The hips are computed from the markers of the pelvis. Without these, the hips are
/// the hip joint centres in the file ("V_R.Hip_JC", "RHJC"). A marker on a thigh, shank or upper arm is never a joint.
/// The set may be incomplete. `names` are the file's names of all columns. Returns nullopt if the names do not
/// show skin markers.
std::optional<MarkerSet> SetOfSkinNames(const MarkerColumns& columns, std::span<const std::string> names);

/// Returns a sentence for users if a set uses a marker called "thigh" as a hip, but the marker is on the thigh: its
/// median distance from the knee is below 0.75 times the distance from knee to ankle (for hips, it is 1 to 1.2).
/// Returns "" if the marker may be a hip, and for rules that the user gave.
std::string DescribeWandAsHip(const MarkerMotion& markers, const MarkerSet& set, const MarkerColumns& columns);

}  // namespace etude
