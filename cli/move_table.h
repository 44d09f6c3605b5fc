#pragma once

#include <string>
#include <vector>

#include "bench/gate/comparison.h"

namespace etude {

/// Prints a table of the metrics that moved, with `before` and `after` as the heads of its two sides; at most `most`
/// rows, and how many were left out.
void PrintMoves(const SnapshotComparison& comparison, const std::string& before, const std::string& after,
                std::size_t most);

/// Prints a title and indented lines, or nothing without lines.
void PrintList(const std::string& title, const std::vector<std::string>& lines);

}  // namespace etude
