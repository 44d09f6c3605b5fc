#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/trc.h"
#include "engine/motion/body.h"

namespace etude {

/// A frame of an even grid: `part` (0 to 1) of the way from `row` to `next`.
struct GridFrame {
  std::size_t row = 0, next = 0;
  double part = 0;
  bool is_hole = false;  ///< by the clock, a row is missing here
};

/// The even grid on which a file's rows lie by their clock.
struct RowGrid {
  double rate_hz = 0;
  std::vector<GridFrame> frames;
  bool is_even = true;  ///< the grid's frames are the rows
  std::string remark;   ///< holes, uneven steps and equal times, for people; "" without
};

/// Lays rows on an even grid by their times, which may be rounded to some decimals. The rate is the one that fits the
/// steps between neighbouring rows; a whole one, or `told_hz` (of the file's header, if any), if it lies within their
/// rounding. Rows that span less than half a second have `told_hz`, or no clock if they differ from it by more than 5
/// %. A frame is a row that lies within a tenth of a frame of it (or the rounding of times), else it is interpolated,
/// or a hole if a row is missing. Of rows with equal times the last one counts. Returns nullopt if there is no clock:
/// fewer than two rows, no time, or equal times. Fails, naming the row's line (`lines` may be empty), for a missing
/// time, falling times, steps over ten minutes, and holes of more than ten million values in all, `width` values a
/// frame.
Result<std::optional<RowGrid>> GridOfRows(std::span<const double> times_s, std::span<const int> lines,
                                          std::optional<double> told_hz, std::size_t width, const std::string& file);

/// Returns times in seconds from frame numbers, if these ascend and are whole: rows are 1 / rate_hz apart where the
/// number rises by its median step. Returns nothing otherwise.
std::vector<double> TimesOfNumbers(std::span<const double> numbers, double rate_hz);

/// Markers as rows of a file, before they are laid on its clock.
struct MarkerRows {
  MarkerMotion markers;
  std::vector<double> times_s;  ///< of each row; NaN if it tells none
  std::vector<int> lines;       ///< of each row, from 1
  std::string rate_name = "";   ///< the header that tells `markers.rate_hz`, "" if none does
};
/// Lays markers on their clock: in a hole no marker was seen. The remark says what was changed. Fails as GridOfRows.
Result<MarkerMotion> LayOnClock(MarkerRows rows, const std::string& file);

/// Lays a body's rows on their clock. Holes of up to a second are bridged linearly; of rows with longer holes the
/// longest stretch without one is kept. `remark` says so. Fails as GridOfRows.
Result<BodyMotion> LayOnClock(BodyMotion rows, std::span<const double> times_s, const std::string& file,
                              std::string& remark);

}  // namespace etude
