#include "bench/statistics/summary.h"

#include <algorithm>

#include "bench/statistics/bootstrap.h"
#include "bench/statistics/expectations.h"
#include "bench/statistics/family.h"
#include "bench/statistics/proportion.h"
#include "bench/statistics/select.h"

namespace etude {
namespace {

/// The metrics that a method's cells report, in the order of the catalogue.
std::vector<const MetricInfo*> MetricsIn(std::span<const Row* const> rows) {
  std::vector<const MetricInfo*> present;
  for (const MetricInfo& metric : AllMetrics()) {
    const auto reports = [&](const Row* row) {
      return std::any_of(row->result.metrics.begin(), row->result.metrics.end(),
                         [&](const MetricValue& value) { return value.id == metric.id; });
    };
    if (std::any_of(rows.begin(), rows.end(), reports)) present.push_back(&metric);
  }
  return present;
}

/// A share of worlds has its own interval: a bootstrap of none in sixty sees no chance of one.
std::optional<Interval> IntervalOf(std::span<const double> values, Aggregate aggregate, std::uint64_t seed,
                                   const std::string& purpose) {
  const bool is_share =
      std::all_of(values.begin(), values.end(), [](double value) { return value == 0 || value == 1; });
  if (aggregate == Aggregate::kMedian || !is_share) return BootstrapInterval(values, aggregate, seed, purpose);
  const auto count = std::count(values.begin(), values.end(), 1.0);
  return WilsonInterval(static_cast<int>(count), static_cast<int>(values.size()));
}

MetricSummary SummariseMetric(const MetricInfo& metric, std::span<const Row* const> rows, const std::string& method,
                              std::uint64_t seed, const std::string& purpose) {
  MetricSummary summary;
  summary.id = metric.id;
  const std::vector<double> values = ValuesOf(rows, method, metric.id, summary.missing);
  summary.present = static_cast<int>(values.size());
  if (values.empty()) return summary;
  summary.median = Quantile(values, 0.5);
  summary.mean = Mean(values);
  if (const auto interval = IntervalOf(values, metric.aggregate, seed, purpose)) {
    summary.ci_low = interval->low;
    summary.ci_high = interval->high;
    summary.interval = interval->kind;
  }
  return summary;
}

MethodSummary SummariseMethod(const std::string& method, std::span<const Row* const> rows,
                              std::span<const MetricInfo* const> metrics, const Study& study,
                              const std::vector<SweptValue>& condition, std::uint64_t seed) {
  MethodSummary summary;
  summary.method = method;
  for (int i = 0; i <= static_cast<int>(Status::kSkipped); ++i) {
    const auto status = static_cast<Status>(i);
    const auto count = std::count_if(rows.begin(), rows.end(), [&](const Row* row) {
      return row->method == method && row->result.status == status;
    });
    if (count > 0) summary.statuses.emplace_back(status, static_cast<int>(count));
    if (status == Status::kOk) summary.ok = static_cast<int>(count);
    if (status != Status::kSkipped) summary.attempted += static_cast<int>(count);
  }
  if (summary.attempted > 0) {
    const Interval interval = WilsonInterval(summary.ok, summary.attempted);
    summary.ok_low = interval.low;
    summary.ok_high = interval.high;
  }
  for (const MetricInfo* metric : metrics) {
    const std::string purpose = PurposeOf(study.scenario, condition, metric->id, "", method);
    summary.metrics.push_back(SummariseMetric(*metric, rows, method, seed, purpose));
  }
  return summary;
}

struct Asked {
  Comparison comparison;
  std::optional<Comparison> with_failures;
};

/// All comparisons of one condition, verdicts left open: they depend on the other conditions too.
std::vector<Asked> CompareAll(const Study& study, const std::vector<SweptValue>& condition,
                              std::span<const Row* const> rows, std::uint64_t seed) {
  std::vector<Asked> asked;
  for (const ComparedMethod& entry : study.methods) {
    if (entry.name == entry.against) continue;
    for (const std::string& id : study.metrics) {
      const MetricInfo& metric = *FindMetric(id);
      const PairedWorlds worlds = PairsOf(rows, entry.against, entry.name, id);
      const std::string purpose = PurposeOf(study.scenario, condition, id, entry.against, entry.name);
      Comparison comparison = ComparePaired(worlds.pairs, metric, seed, purpose);
      comparison.baseline = entry.against;
      comparison.method = entry.name;
      comparison.only_baseline = worlds.only_baseline;
      comparison.only_method = worlds.only_method;
      comparison.neither = worlds.neither;
      asked.push_back({std::move(comparison), CompareWithFailures(worlds.pairs, worlds.failed, metric, seed, purpose)});
    }
  }
  return asked;
}

}  // namespace

ScenarioSummary Summarise(const Study& study, std::span<const Row> rows, std::uint64_t seed) {
  ScenarioSummary summary{study.scenario, study.task, study.question, study.unit, {}, study.metrics, {}, {}};
  for (const ComparedMethod& entry : study.methods) summary.methods.push_back(entry.name);
  std::vector<std::optional<Comparison>> with_failures;  // of all conditions' comparisons, in order
  for (const std::vector<SweptValue>& condition : study.conditions) {
    const std::vector<const Row*> selected = RowsIn(rows, condition);
    const std::vector<const MetricInfo*> metrics = MetricsIn(selected);
    ConditionSummary& part = summary.conditions.emplace_back();
    part.condition = condition;
    for (const ComparedMethod& entry : study.methods) {
      part.methods.push_back(SummariseMethod(entry.name, selected, metrics, study, condition, seed));
    }
    for (Asked& asked : CompareAll(study, condition, selected, seed)) {
      part.comparisons.push_back(std::move(asked.comparison));
      with_failures.push_back(std::move(asked.with_failures));
    }
  }
  std::vector<Question> family;
  for (ConditionSummary& part : summary.conditions) {
    for (Comparison& comparison : part.comparisons) {
      family.push_back({&comparison, std::move(with_failures[family.size()])});
    }
  }
  JudgeFamily(family);
  summary.family = static_cast<int>(family.size());
  for (const Expectation& expectation : study.expectations) {
    summary.expectations.push_back(JudgeExpectation(expectation, study, rows, seed));
  }
  return summary;
}

}  // namespace etude
