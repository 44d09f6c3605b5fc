#pragma once

#include "engine/formats/trc.h"

namespace etude {

/// Replaces positions that stand for gaps by missing positions: positions a hundred times farther away than the others,
/// and 0, 0, 0 if the marker has other positions in other frames, if it belongs to a limb and other markers move, or if
/// the body is far from the origin. Appends a text about these changes, and about names that several markers share, to
/// the motion's `remark`.
void RepairMarkers(MarkerMotion& markers);

}  // namespace etude
