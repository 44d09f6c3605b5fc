#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "bench/run/cell_runner.h"

namespace etude {

/// Encodes a finished cell as one line of JSON: the form in which a worker sends it and the journal keeps it. The line
/// holds the cell's number in the plan, all that Plan::IdentityOf does not give, its usage, and a checksum. A metric of
/// the catalogue is written as its index there, which is the same in all files of one build; a scenario's own metric as
/// its id. The members have a fixed order, so that a line can be read in a microsecond, or passed on unread.
///
///     {"cell":12,"status":"unsolved","reason":"…","usage":[wall_s,cpu_s,peak_mb,world_wall_s,world_cpu_s],
///      "values":[3,0.5,4,null],"why":["no truth"],"digests":["world","0123456789abcdef"],
///      "series":[["position_error_cm","iteration",[3,2,1]]],"recording":{…},"sum":"0123456789abcdef"}
///
/// If other programs have yet to measure the cell, the line begins with `answered` instead of `cell`, and its motion is
/// in `recording`. Empty members and an empty `reason` are left out. Only the first cell of a world has the last two
/// numbers of `usage`. A series of category indices has the names of the categories after its values. A value that is
/// not finite, or a metric that the catalogue does not know, turns the cell into bad_output.
std::string EncodeCellLine(std::size_t cell, FinishedCell finished);

/// The first members of a line.
struct CellLineHead {
  std::size_t cell = 0;
  Status status = Status::kFailed;
  bool is_measured = true;  ///< as FinishedCell::is_measured
};

/// The beginning of the line of a cell that other programs have yet to measure.
inline constexpr std::string_view kAnsweredBegin = R"({"answered":)";

/// Reads the first members; nothing if the line is not as EncodeCellLine wrote it.
std::optional<CellLineHead> ReadCellLineHead(std::string_view line);

/// Reads a whole line. `identity` is the row of its cell, without a result. Fails if the line has been changed.
Result<FinishedCell> DecodeCellLine(std::string_view line, Row identity, const Place& place);

/// Appends a last member, `sum`, the digest of the text, to a JSON object on one line without a line end.
std::string WithSum(std::string json);
bool HasRightSum(std::string_view line);

}  // namespace etude
