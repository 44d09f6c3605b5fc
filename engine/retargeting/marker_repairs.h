#pragma once

#include "engine/formats/trc.h"

namespace etude {

/// Replaces positions that stand for gaps by missing positions: positions that are a hundred times farther from the
/// middle of the frame's markers than the median marker, and 0, 0, 0 if the marker has other positions in other frames,
/// if it belongs to a limb and other markers move, or if the body is far from the origin. Appends a text about these
/// changes, and about names that several markers share, to the motion's `remark`.
void RepairMarkers(MarkerMotion& markers);

}  // namespace etude
