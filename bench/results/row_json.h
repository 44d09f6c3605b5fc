#pragma once

#include "bench/model/row.h"
#include "io/files/json.h"

namespace etude {

/// A row as a line of cells.jsonl: flat, identity first, metrics under their ids, null where a value is
/// missing (why: "null_reasons"), stage digests as "digest_<stage>".
Json EncodeRow(const Row& row);
Result<Row> DecodeRow(const Json& json, const Place& place);

Json EncodeSeries(const std::vector<Series>& series);
/// A line of series/SCENARIO.jsonl.
Json EncodeSeriesLine(const std::string& cell, const std::vector<Series>& series);
std::vector<Series> DecodeSeries(const Json& json);

/// The version of the files of `recordings/`. The first named no joints.
constexpr int kRecordingVersion = 2;

/// Encodes what a recording holds of a cell: each track's poses as rows of 60 numbers (x, y, z of the 20 joints,
/// metres), and the extras of its task.
Result<Json> EncodeMotions(const Recording& recording);
/// A recording as its file has it: the version, the names of the joints in the order of the numbers, their unit and the
/// axis that points up, then the motions.
Result<Json> EncodeRecording(const Recording& recording);
/// Refused: another version, with what it lacks; other joints, or in another order.
Result<Recording> DecodeRecording(const Json& json, const Place& place);
/// Reads a recording's text.
Result<Recording> ReadRecording(const std::string& text, const std::string& file);

/// A line of timings.jsonl.
Json EncodeUsage(const std::string& cell, const CellUsage& usage);

}  // namespace etude
