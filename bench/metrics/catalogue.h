#pragma once

#include <span>
#include <string>
#include <string_view>

namespace etude {

enum class Direction { kLowerIsBetter, kHigherIsBetter, kNeither };
/// "lower is better", "higher is better", or "" for neither.
std::string_view DirectionWords(Direction direction);

/// How a run sums up the cells' values: shares and other 0/1 values by their mean, the rest by median.
enum class Aggregate { kMedian, kMean };

/// What a metric means: the entry that tables, comparisons and other implementations go by.
struct MetricInfo {
  std::string id;     ///< unit in the name, e.g. "position_error_cm"
  int version = 1;    ///< raised when the definition changes; values of two versions never mix
  std::string label;  ///< for people: "position error"
  std::string unit;   ///< "cm", "deg", "" for shares and counts
  Direction direction = Direction::kLowerIsBetter;
  Aggregate aggregate = Aggregate::kMedian;
  double practical = 0;    ///< the smallest difference that matters, in the metric's unit
  std::string definition;  ///< one sentence
};

std::span<const MetricInfo> AllMetrics();
/// Null when there is no such metric.
const MetricInfo* FindMetric(std::string_view id);

}  // namespace etude
