#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/trc.h"
#include "engine/motion/body.h"

namespace etude {

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

/// Computes times in seconds from frame numbers, if the numbers are whole and ascend; otherwise returns an empty list.
/// The median difference between consecutive numbers becomes 1 / rate_hz seconds.
std::vector<double> TimesOfNumbers(std::span<const double> numbers, double rate_hz);

/// Markers in the rows of a file, before they are placed on frames.
struct MarkerRows {
  MarkerMotion markers;
  std::vector<double> times_s;  ///< time of each row; NaN if the row gives none
  std::vector<double> numbers = {};  ///< frame number of each row, NaN for a missing one; empty if the file has none
  std::vector<int> lines;       ///< line of each row, from 1
  bool has_clock = true;        ///< false if the times were made from frame numbers
  double first_number = 0;      ///< number of the first row's frame, if the times were made from frame numbers
  std::string rate_name = "";   ///< the header that gives `markers.rate_hz`; "" if none does
  std::string time_name = "the column Time";  ///< the column or channel of the times, as messages name it
};
/// Computes the times of the rows from their frame numbers at the rate `rate_hz` (TimesOfNumbers), because they have no
/// clock.
void TakeTimesFromNumbers(MarkerRows& rows, double rate_hz);
/// Places markers on frames by their times, whose unit FindTimeScale finds. In a frame whose row is missing, no marker
/// counts as seen. The remark says what was changed. Fails like GridOfRows.
Result<MarkerMotion> LayOnClock(MarkerRows rows, const std::string& file);

/// Resamples the rows of a CSV at evenly spaced frames. If the CSV has no times, they are computed from its frame
/// numbers at the rate kJudgedRateHz (TimesOfNumbers).
Result<MarkerMotion> LayOnClock(const JointCsv& csv, const std::string& file);

/// Resamples a body's motion at evenly spaced frames; `times_s` holds the time of each row. A hole (missing rows) of
/// up to a second is bridged linearly. If there are longer holes, only the longest stretch of frames without such a
/// hole is kept. `remark` says what was changed. Fails like GridOfRows.
Result<BodyMotion> LayOnClock(BodyMotion rows, std::span<const double> times_s, const std::string& file,
                              std::string& remark, double& start_s);

}  // namespace etude
