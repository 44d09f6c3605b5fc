#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "bench/run/cell_runner.h"

namespace etude {

/// A finished cell as a worker answers it and as the journal keeps it: one line of JSON with its number in the plan,
/// all that is not said by that number (Plan::IdentityOf), what it took, and a sum of the text. Metrics go by their
/// place in the catalogue, which is the same for all that one build writes, or a scenario's own by their names. Short,
/// and always in the same order, so that a line is read in a microsecond and passed on without being read at all.
///
///     {"cell":12,"status":"unsolved","reason":"…","usage":[wall_s,cpu_s,peak_mb,world_wall_s,world_cpu_s],
///      "values":[3,0.5,4,null],"why":["no truth"],"digests":["world","0123456789abcdef"],
///      "series":[["position_error_cm","iteration",[3,2,1]]],"recording":{…},"sum":"0123456789abcdef"}
///
/// A cell that other programs have yet to measure begins with `answered` in the place of `cell`, and has its motion as
/// `recording`. Parts that would be empty are left out, as is `reason` where there is none. The last two numbers of
/// `usage` stand in a world's first cell only. A series of category indices appends the category names after its
/// values. A value that is not finite, or a metric that the catalogue does not know, turns the cell into bad_output.
std::string EncodeCellLine(std::size_t cell, FinishedCell finished);

/// What a line begins with.
struct CellLineHead {
  std::size_t cell = 0;
  Status status = Status::kFailed;
  bool is_measured = true;  ///< false: FinishedCell::is_measured
};

/// The beginning of the line of a cell that has yet to be measured.
inline constexpr std::string_view kAnsweredBegin = R"({"answered":)";

/// Reads a line back; nothing when it is not as EncodeCellLine wrote it.
std::optional<CellLineHead> ReadCellLineHead(std::string_view line);

/// Reads a line that is as it was written; `identity` is the row of its cell, without a result.
Result<FinishedCell> DecodeCellLine(std::string_view line, Row identity, const Place& place);

/// Appends a last member, `sum`, to a JSON object in one line: the digest of its text. Neither has a line end.
std::string WithSum(std::string json);
bool HasRightSum(std::string_view line);

}  // namespace etude
