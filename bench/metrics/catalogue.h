#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"

namespace etude {

enum class Direction { kLowerIsBetter, kHigherIsBetter, kNeither };
/// "lower is better", "higher is better", or "" for neither.
std::string_view DirectionWords(Direction direction);

/// The way in which a run sums up the cells' values: shares and other 0/1 values by their mean, the rest by median.
enum class Aggregate { kMedian, kMean };

/// The kind of a cell's value, so that people are told in the right words: shares and scores are shown in per cent, and
/// their differences in percentage points.
enum class Reading {
  kAmount,  ///< so much of the metric's unit, or so many
  kYesNo,   ///< 1 or 0: a run has a share of cells
  kShare,   ///< of something within the cell, 0…1: a run has a mean share
  kScore,   ///< 0…1, of what has a name of its own: F1, recall
};

/// A key of the input of a metric's test vectors.
struct MetricInput {
  std::string key;
  std::string meaning;  ///< shape and unit
};

/// A metric's value for one input, known without this program: what another implementation must agree with.
struct MetricVector {
  std::string_view title;          ///< what it is about: "one joint of twenty jumps"
  std::string_view input_json;     ///< one JSON object, with the keys of MetricInfo::inputs
  std::optional<double> expected;  ///< nothing: the metric has no value here
  std::string_view null_reason;    ///< why it has none; "" when it has
  double tolerance = 0;            ///< absolute, in the metric's unit
  std::string_view source;         ///< "derived: …" or "published: …"
};

/// The definition of a metric: the entry that tables, comparisons and other implementations go by.
struct MetricInfo {
  std::string id;     ///< unit in the name, e.g. "position_error_cm"
  int version = 1;    ///< raised when the definition changes; values of two versions never mix
  std::string label;  ///< for people: "position error"
  std::string unit;   ///< "cm", "deg", "" for shares and counts
  Direction direction = Direction::kLowerIsBetter;
  Aggregate aggregate = Aggregate::kMedian;
  Reading reading = Reading::kAmount;
  bool is_success = false;  ///< it tells whether, or how far, a cell reached what its task is about; `ok` does not
  double practical = 0;     ///< the smallest difference that matters, in the metric's unit
  std::string definition;   ///< one sentence

  std::string practical_reason;     ///< why nobody would act on less than `practical`
  std::string formula;              ///< the definition to the letter: frames, denominators, edge cases
  std::string null_rule;            ///< when it has no value although the method answered
  std::string source;               ///< where the definition comes from
  std::vector<MetricInput> inputs;  ///< what its test vectors give
  std::span<const MetricVector> vectors = {};
  std::string domain = {};  ///< "Inverse kinematics", …: its heading on the page
};

/// All files of bench/metrics/catalogue, in the order of tables and of docs/reference/metrics.md.
std::span<const MetricInfo> AllMetrics();
/// Adds a metric that a scenario brings along, so that FindMetric finds it: whoever reads a scenario or its run does so
/// first. Fails when the id is the catalogue's own, or was added with another definition: the values of two never mix.
Result<void> AddMetric(MetricInfo metric);
/// Returns the metrics that were added, by id.
const std::map<std::string, MetricInfo, std::less<>>& AddedMetrics();
/// A metric of the catalogue, or one that was added. Null when there is no such metric.
const MetricInfo* FindMetric(std::string_view id);

}  // namespace etude
