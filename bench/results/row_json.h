#pragma once

#include "bench/model/row.h"
#include "io/files/json.h"

namespace etude {

/// Encodes a row as a line of cells.jsonl: one object, flat except for the keys "units", "null_reasons" and
/// "judged". The identity comes first, then the metrics with their ids as keys. A missing value is null, and its reason
/// is in "null_reasons". Stage digests have keys "digest_<stage>".
Json EncodeRow(const Row& row);
Result<Row> DecodeRow(const Json& json, const Place& place);

/// Encodes the joints, rates and shares on which a cell was judged; an empty object if the task does not state them.
Json EncodeJudged(const JudgedOn& judged);
JudgedOn DecodeJudged(const Json& json);

Json EncodeSeries(const std::vector<Series>& series);
/// Encodes a line of series/SCENARIO.jsonl.
Json EncodeSeriesLine(const std::string& cell, const std::vector<Series>& series);
std::vector<Series> DecodeSeries(const Json& json);

/// The version of the files in `recordings/`. Version 1 did not name the joints.
constexpr int kRecordingVersion = 2;

/// Encodes each track's poses as rows of 60 numbers (x, y, z of the 20 joints, metres), and the extras of the task.
Result<Json> EncodeMotions(const Recording& recording);
/// Encodes the file of a recording: version, names of the joints in order, unit, up axis, and the motions.
Result<Json> EncodeRecording(const Recording& recording);
/// Reads the JSON of EncodeRecording. Fails if the version, the joints or their order, the unit or the up axis differs.
Result<Recording> DecodeRecording(const Json& json, const Place& place);
Result<Recording> ReadRecording(const std::string& text, const std::string& file);

/// Encodes a line of timings.jsonl.
Json EncodeUsage(const std::string& cell, const CellUsage& usage);

}  // namespace etude
