#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/formats/row_clock.h"

namespace etude {

/// A table of positions: one row per frame, with a column for each coordinate of each point.
struct PointTable {
  MarkerRows rows;        ///< positions in the headings' unit converted to metres, or in the file's unit
  bool has_unit = false;  ///< true: the headings state the unit
  bool has_rate = false;  ///< true: the table has times; otherwise the rate is kJudgedRateHz
};

/// Returns true if the first line that is not a comment names x, y and z of at least three points, in one of these
/// forms: wrist_x (also with `.`, `:`, `-` or a space), x_wrist, WristX, x1, 1x; with or without a unit (_mm, [cm]).
bool IsPointTable(std::string_view text);

/// Reads such a table as ReadNumberRows reads numbers. A column `time`, `timestamp` or `t`, with or without a unit (s,
/// ms, us, ns, min), gives the times; a column `frame`, `index` or one without a heading gives the frame numbers.
/// Words such as `pos` are no part of a point's name. Other columns, and points whose names say velocity, acceleration,
/// rotation or the like, are left out, and the remark lists them. Returns an error for anything that ReadNumberRows
/// refuses, a heading twice, a point without all three coordinates, several units, times that are text, a column of
/// people (person, id, track …) with several values, more than a thousand points or a million rows, and positions
/// beyond ±10⁹.
Result<PointTable> ReadPointTable(std::string_view text, const std::string& file);

}  // namespace etude
