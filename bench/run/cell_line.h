#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "bench/run/cell_runner.h"

namespace etude {

/// Encodes a finished cell as one line of JSON. A worker sends the cell in this form, and the journal stores it. The
/// line contains the cell's number in the plan, the result, the usage of time and memory, and a checksum. The number
/// determines the cell's identity (Plan::IdentityOf). A metric of the catalogue (bench/metrics/catalogue.h) is written
/// as its index in the catalogue. This index is the same in all files of one build. A scenario's own metric is written
/// as its id. The members have a fixed order, so a line can be read in a microsecond, or be copied without being read.
///
///     {"cell":12,"status":"unsolved","reason":"…","usage":[wall_s,cpu_s,peak_mb,world_wall_s,world_cpu_s],
///      "values":[3,0.5,4,null],"why":["no truth"],"digests":["world","0123456789abcdef"],
///      "series":[["position_error_cm","iteration",[3,2,1]]],"recording":{…},"sum":"0123456789abcdef"}
///
/// If metrics that outside programs compute are still missing, the line begins with `answered` instead of `cell`, and
/// the cell's motion is in `recording`. Empty members and an empty `reason` are left out. The last two numbers of
/// `usage` are the time of building the world; only the first cell of a world has them. A series of category indices
/// has the names of the categories after its values. A value that is not finite, or a metric that FindMetric does not
/// know, turns the cell's status into bad_output.
std::string EncodeCellLine(std::size_t cell, FinishedCell finished);

/// The first members of a cell's line, which can be read quickly.
struct CellLineHead {
  std::size_t cell = 0;
  Status status = Status::kFailed;
  /// False if outside metric programs must still measure the cell (FinishedCell::is_measured).
  bool is_measured = true;
};

/// The beginning of the line of a cell that outside metric programs must still measure.
inline constexpr std::string_view kAnsweredBegin = R"({"answered":)";

/// Reads the first members of a line. Returns nullopt if EncodeCellLine did not write the line.
std::optional<CellLineHead> ReadCellLineHead(std::string_view line);

/// Reads a whole line. `identity` is the cell's row without a result. Fails if the line was changed after it was
/// written.
Result<FinishedCell> DecodeCellLine(std::string_view line, Row identity, const Place& place);

/// Appends a checksum to a JSON object on one line: a last member, `sum`, whose value is the digest of the text before
/// it. `json` has no line end.
std::string WithSum(std::string json);
bool HasRightSum(std::string_view line);

}  // namespace etude
