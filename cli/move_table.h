#pragma once

#include <string>
#include <vector>

#include "bench/gate/comparison.h"

namespace etude {

/// Prints a table of the metrics that moved; `before` and `after` are the headings of its two value columns. It prints
/// at most `max_rows` rows, and the number of rows left out.
void PrintMoves(const SnapshotComparison& comparison, const std::string& before, const std::string& after,
                std::size_t max_rows);

/// Prints a title and indented lines; prints nothing if there are no lines.
void PrintList(const std::string& title, const std::vector<std::string>& lines);

}  // namespace etude
