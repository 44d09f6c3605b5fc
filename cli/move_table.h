#pragma once

#include <string>

#include "bench/gate/comparison.h"

namespace etude {

/// Prints a table of the metrics that changed; `before` and `after` are the headings of the table's two value columns.
/// Prints at most `max_rows` rows, then the number of rows left out.
void PrintMoves(const SnapshotComparison& comparison, const std::string& before, const std::string& after,
                std::size_t max_rows);

}  // namespace etude
