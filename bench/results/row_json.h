#pragma once

#include "bench/files/json.h"
#include "bench/model/row.h"

namespace etude {

/// A row as a line of cells.jsonl: flat, identity first, metrics under their ids, null where a value is
/// missing (why: "null_reasons"), stage digests as "digest_<stage>".
Json EncodeRow(const Row& row);
Result<Row> DecodeRow(const Json& json, const Place& place);

Json EncodeSeries(const std::vector<Series>& series);
std::vector<Series> DecodeSeries(const Json& json);

/// A recording: each track's poses as rows of 60 numbers (x, y, z of the 20 joints, metres).
Result<Json> EncodeRecording(const Recording& recording);
Result<Recording> DecodeRecording(const Json& json, const Place& place);
/// Reads a recording's text.
Result<Recording> ReadRecording(const std::string& text, const std::string& file);

/// A line of timings.jsonl.
Json EncodeUsage(const std::string& cell, const CellUsage& usage);

}  // namespace etude
