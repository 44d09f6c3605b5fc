#pragma once

#include "io/clips/recorded_motions.h"

namespace etude {

/// Returns the reader of recordings in result folders, for `OpenOptions::recorded`. In the reference "RUN#CELL@NAME",
/// NAME is a track of the cell's recording, or another method of the same world. CELL may be a cell's identity without
/// the method. Symbolic links in the run's folder are refused, because a stranger may have made the run.
const RecordedMotions& MotionsOfRuns();

}  // namespace etude
