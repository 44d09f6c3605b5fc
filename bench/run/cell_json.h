#pragma once

#include "bench/files/json.h"
#include "bench/run/cell_runner.h"

namespace etude {

/// A finished cell as workers answer it and as the journal keeps it: `row`, `series` and `recording` where
/// there are such (bench/results/row_json.h), and `usage`.
Json EncodeFinishedCell(FinishedCell cell);
Result<FinishedCell> DecodeFinishedCell(const Json& json, const Place& place);

/// A line of timings.jsonl.
Json EncodeUsage(const std::string& cell, const CellUsage& usage);

}  // namespace etude
