#pragma once

#include "engine/formats/trc.h"

namespace etude {

/// Turns positions that stand for gaps into gaps: 0, 0, 0 of markers that are elsewhere in other frames, or always
/// there although they are of limbs and others move, or although the body is elsewhere; and positions
/// a hundred times as far away as the others. Appends these changes to `remark`, and the names that several markers
/// have.
void RepairMarkers(MarkerMotion& markers);

}  // namespace etude
