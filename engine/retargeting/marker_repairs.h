#pragma once

#include <cstddef>
#include <set>
#include <string>

#include "engine/formats/trc.h"

namespace etude {

/// Some programs write special numbers instead of a missing position. Removes such positions:
/// - positions that are more than a hundred times as far from the middle of the frame's markers as the median marker
/// - positions with three equal coordinates (apart from signs), if the same number occurs more than once
/// - positions at (0, 0, 0), if the marker is elsewhere in other frames, or if the body is far from the origin
/// - positions at (0, 0, 0) of a marker on an arm or a leg, if any marker moves
///
/// `used` lists the columns from which the middle and the usual distances are computed; empty: all columns, although
/// some columns of a C3D file may contain angles and forces. Appends a text about these changes, and about names that
/// several markers share (unless DescribeEqualNames does), to the motion's `remark`.
void RepairMarkers(MarkerMotion& markers, const std::set<std::size_t>& used = {});

/// Describes names that several markers share, if one of them is in a used column: the markers may be of two people.
/// Otherwise returns "".
std::string DescribeEqualNames(const MarkerMotion& markers, const std::set<std::size_t>& used);

}  // namespace etude
