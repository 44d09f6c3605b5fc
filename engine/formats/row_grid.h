#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// Rows that span less than half a second contradict a stated rate if their own rate differs by more than this share.
inline constexpr double kBriefTolerance = 0.05;

/// One frame of an even grid, interpolated between two rows: `part` is 0 at `row` and 1 at `next`.
struct GridFrame {
  std::size_t row = 0, next = 0;
  double part = 0;
  bool is_hole = false;  ///< true if a row is missing at this time
};

/// The even grid of frames on which a file's rows are placed by their times.
struct RowGrid {
  double rate_hz = 0;
  std::vector<GridFrame> frames;
  bool is_even = true;  ///< true if every frame is exactly one row
  std::string remark;   ///< a text for users about holes, uneven steps and equal times; "" if there are none
};

/// Places rows on an even grid of frames by their times, which may be rounded to some decimals. The rate fits the steps
/// between neighbouring rows; a whole rate, or `told_hz` (from the file's header, if any), is preferred if the rounding
/// of the times allows it. Between holes, rows count as evenly spaced if times are printed so coarsely that
/// neighbouring rows share a time; the length of a hole is then uncertain by this rounding. With `told_hz`, rows that
/// span less than half a second get this rate, or count as having no clock if their own rate differs from it by more
/// than 5 %. A frame takes the row whose time differs from the frame's time by at most a tenth of the frame period (or
/// by the rounding of the times). Without such a row, the frame is interpolated between two rows, or it is a hole if a
/// row is missing. Of rows with equal times only the last is used. Returns nullopt if there is no clock: there are
/// fewer than two rows, no row has a time, or all times are equal. Fails, naming the row's line (`lines` may be empty),
/// for a missing time, decreasing times, steps over ten minutes, more than four rows per time, more than 10 kHz, and
/// holes of more than ten million values in total, `width` values per frame.
Result<std::optional<RowGrid>> GridOfRows(std::span<const double> times_s, std::span<const int> lines,
                                          std::optional<double> told_hz, std::size_t width, const std::string& file);

}  // namespace etude
