#pragma once

#include <string>

#include "bench/gate/comparison.h"
#include "io/files/json.h"

namespace etude {

/// Prints a table of the metrics that changed; `before` and `after` are the headings of the table's two value columns.
/// Prints at most `max_rows` rows, then the number of rows left out.
void PrintMoves(const SnapshotComparison& comparison, const std::string& before, const std::string& after,
                std::size_t max_rows);

/// Returns, as JSON, the metrics that changed between the two snapshots of a comparison, and the entries that only one
/// of these snapshots has.
Json FactsOf(const SnapshotComparison& comparison);

/// Prints a line unless this program's version made both results: "Versions of Etude differ: A was made by 0.3.1, B
/// by 0.4.0; this is Etude 0.4.0".
void PrintVersions(const std::string& before, const std::string& before_version, const std::string& after,
                   const std::string& after_version);

}  // namespace etude
