#pragma once

#include "bench/model/row.h"
#include "bench/replay/replay.h"

namespace etude {

/// Compares a row with the one that came when the cell was run again: stage by stage, then status, then metrics.
CellCheck CompareRows(const Row& then, const Row& now);

}  // namespace etude
