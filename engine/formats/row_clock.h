#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/row_grid.h"
#include "engine/formats/trc.h"
#include "engine/motion/body.h"

namespace etude {

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
