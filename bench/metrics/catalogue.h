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
/// Returns "lower is better" or "higher is better"; "" if the metric has no direction.
std::string_view DirectionWords(Direction direction);

/// The way in which a run aggregates the cells' values. The catalogue states it for each metric: the mean for shares,
/// counts and penalised costs, among others; the median for most errors.
enum class Aggregate { kMedian, kMean };

/// The kind of a cell's value. It decides how the value is displayed: shares and scores are shown in per cent, and
/// their differences in percentage points.
enum class Reading {
  kAmount,  ///< an amount in the metric's unit, or a count
  kYesNo,   ///< 1 or 0; the value of a run is the share of cells with 1
  kShare,   ///< a share of something within the cell, 0…1; the value of a run is the mean
  kScore,   ///< a score from 0 to 1, e.g. F1 or recall
};

/// A key of the JSON input of a metric's test vectors.
struct MetricInput {
  std::string key;
  std::string meaning;  ///< shape and unit of the value
};

/// A test vector: an input and the metric's known value for it. Every implementation must agree with it.
struct MetricVector {
  std::string_view title;          ///< the tested case, e.g. "one joint of twenty jumps"
  std::string_view input_json;     ///< one JSON object, with the keys of MetricInfo::inputs
  std::optional<double> expected;  ///< the known value; nullopt: the metric has no value for this input
  std::string_view null_reason;    ///< why the metric has no value; "" if it has one
  double tolerance = 0;            ///< absolute tolerance, in the metric's unit
  std::string_view source;         ///< origin of the known value: "derived: …" or "published: …"
};

/// The definition of a metric. Tables and comparisons use it; MetricsJson exports it for other implementations.
struct MetricInfo {
  std::string id;     ///< e.g. "position_error_cm"; it ends with the unit
  int version = 1;    ///< raised if the definition changes; values of two versions are never mixed
  std::string label;  ///< the name for display, e.g. "position error"
  std::string unit;   ///< e.g. "cm", "deg"; "" for shares and counts
  Direction direction = Direction::kLowerIsBetter;
  Aggregate aggregate = Aggregate::kMedian;
  std::string weight = {};  ///< the metric that weights the cells in a mean; "" = all cells count alike
  Reading reading = Reading::kAmount;
  bool is_success = false;  ///< the value says how far a cell reached its task's goal; status `ok` does not say this
  bool by_rate = false;     ///< the value depends on the frame rate; values of two rates are not compared
  double practical = 0;     ///< the smallest difference that matters, in the metric's unit
  std::string definition;   ///< the definition in one sentence

  std::string practical_reason;     ///< why a smaller difference than `practical` does not matter
  std::string formula;              ///< the exact definition: frames, denominators, edge cases
  std::string null_rule;            ///< the cases in which the metric has no value although the method answered
  std::string source;               ///< the origin of the definition
  std::vector<MetricInput> inputs;  ///< the inputs of the metric's test vectors
  std::span<const MetricVector> vectors = {};
  std::string domain = {};  ///< the metric's heading on the reference page, e.g. "Inverse kinematics"
};

/// Returns the metrics of all files in bench/metrics/catalogue, in the order in which tables and
/// docs/reference/metrics.md list them.
std::span<const MetricInfo> AllMetrics();
/// Adds a metric that a scenario defines, so that FindMetric finds it. Every reader of a scenario or of its run must
/// call this before it uses the metric. Fails if the catalogue has this id, or if the id was added with another
/// definition: values of two definitions must not be mixed.
Result<void> AddMetric(MetricInfo metric);
/// Returns the metrics that AddMetric added, by id.
const std::map<std::string, MetricInfo, std::less<>>& AddedMetrics();
/// Returns a metric of the catalogue or an added metric; null if the id is unknown.
const MetricInfo* FindMetric(std::string_view id);

}  // namespace etude
