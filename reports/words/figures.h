#pragma once

#include <optional>
#include <string>

#include "bench/metrics/catalogue.h"
#include "bench/model/summary.h"
#include "io/drawing/numbers.h"

namespace etude {

/// The name and the units of a metric, from the catalogue of metrics. The name is the metric's id if the catalogue does
/// not list the metric. Shares and scores are shown in per cent, their differences in percentage points.
struct MetricWords {
  std::string label;   ///< name of the metric: "orientation error", "share “solved”", "mean F1"
  std::string suffix;  ///< follows a value: "°", " cm", " %", ""
  /// Unit after a difference: the same as `suffix`, but " percentage points" for values in per cent.
  std::string difference_suffix;
  double scale = 1;       ///< factor that turns a stored value into the shown value
  bool is_share = false;  ///< true: the metric is a share, 0…1, shown in per cent
  bool by_mean = false;   ///< true: a metric's typical value is the mean over cells; false: the median
  Direction direction = Direction::kNeither;
  /// The label without “mean” or “share”, for texts that contain these words themselves: "orientation error", "solved",
  /// "F1".
  std::string plain_label = {};
};
MetricWords WordsFor(const std::string& metric_id);
/// Returns the suffix without the space before the unit, for captions: "cm", "".
std::string UnitOf(const MetricWords& words);

/// Returns the typical value of a metric over all cells, in the metric's unit: the median or the mean, as the metric
/// defines.
std::optional<double> TypicalValue(const MetricSummary& summary, const MetricWords& words);
/// Returns a value as text: "12.3°", "98 %"; kNoValue if there is none.
std::string FormatValue(std::optional<double> value, const MetricWords& words);
/// Returns a difference with its unit, which is "pp" for percentage points: "−0.949 mm", "41.7 pp".
std::string ShortDifference(double difference, const MetricWords& words);

/// Returns an interval as text: "10.1–14.0" or "−1.2 to 0.4". Both ends have equally many digits, except that an end
/// that would be shown as 0 has more digits: "−0.0031 to 30.4". Returns kNoValue if there is no interval.
std::string FormatInterval(std::optional<double> low, std::optional<double> high, const MetricWords& words);
}  // namespace etude
