#pragma once

#include <cstddef>
#include <set>

#include "engine/formats/trc.h"

namespace etude {

/// Replaces positions that stand for gaps by missing positions: positions that are a hundred times farther from the
/// middle of the frame's markers than the median marker, and 0, 0, 0 if the marker has other positions in other frames,
/// if it belongs to a limb and other markers move, or if the body is far from the origin. `used` lists the columns that
/// decide what is usual; empty: all columns, although a C3D file may hold angles and forces in some. Appends a text
/// about these changes, and about names that several markers share, to the motion's `remark`.
void RepairMarkers(MarkerMotion& markers, const std::set<std::size_t>& used = {});

}  // namespace etude
