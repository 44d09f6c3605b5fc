#pragma once

#include <optional>
#include <string>

#include "bench/metrics/catalogue.h"
#include "bench/model/summary.h"
#include "io/drawing/numbers.h"

namespace etude {

/// The words of a metric, from the catalogue, or its id when it is not listed there. Shares and scores are shown in per
/// cent, and their differences in percentage points.
struct MetricWords {
  std::string label;              ///< "orientation error"; "share “solved”", "mean F1"
  std::string suffix;             ///< put behind a value: "°", " cm", " %", ""
  std::string difference_suffix;  ///< the same, but " percentage points" where values are in per cent
  double scale = 1;               ///< what values are multiplied by before they are shown
  bool is_share = false;          ///< 0…1, shown in per cent
  bool by_mean = false;           ///< the mean stands for all cells, not the median
  Direction direction = Direction::kNeither;
  std::string plain_label = {};  ///< "orientation error", "solved", "F1": where mean or share is said already
};
MetricWords WordsFor(const std::string& metric_id);
/// Gives the suffix as a caption has it, without its blank: "cm", "".
std::string UnitOf(const MetricWords& words);

/// Gives the one number that stands for all cells, the metric's own aggregate, median or mean, in the metric's unit.
std::optional<double> TypicalValue(const MetricSummary& summary, const MetricWords& words);
/// Writes a value: "12.3°", "98 %"; kNoValue without one.
std::string FormatValue(std::optional<double> value, const MetricWords& words);

/// Writes an interval: "10.1–14.0", both ends with the same digits, or "−1.2 to 0.4"; kNoValue without one.
std::string FormatInterval(std::optional<double> low, std::optional<double> high, const MetricWords& words);
}  // namespace etude
