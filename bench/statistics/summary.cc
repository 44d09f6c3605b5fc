#include "bench/statistics/summary.h"

#include <algorithm>

#include "bench/statistics/bootstrap.h"
#include "bench/statistics/expectations.h"
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

MetricSummary SummariseMetric(const MetricInfo& metric, std::span<const Row* const> rows, const std::string& method,
                              std::uint64_t seed, const std::string& purpose) {
  MetricSummary summary;
  summary.id = metric.id;
  const std::vector<double> values = ValuesOf(rows, method, metric.id, summary.missing);
  summary.present = static_cast<int>(values.size());
  if (values.empty()) return summary;
  summary.median = Quantile(values, 0.5);
  summary.mean = Mean(values);
  if (const auto interval = BootstrapInterval(values, metric.aggregate, seed, purpose)) {
    summary.ci_low = interval->low;
    summary.ci_high = interval->high;
  }
  return summary;
}

MethodSummary SummariseMethod(const std::string& method, std::span<const Row* const> rows,
                              std::span<const MetricInfo* const> metrics, const Scenario& scenario,
                              const Condition& condition, std::uint64_t seed) {
  MethodSummary summary{method, {}, {}};
  for (int i = 0; i <= static_cast<int>(Status::kSkipped); ++i) {
    const auto status = static_cast<Status>(i);
    const auto count = std::count_if(rows.begin(), rows.end(), [&](const Row* row) {
      return row->method == method && row->result.status == status;
    });
    if (count > 0) summary.statuses.emplace_back(status, static_cast<int>(count));
  }
  for (const MetricInfo* metric : metrics) {
    const std::string purpose = PurposeOf(scenario.name, condition.settings, metric->id, "", method);
    summary.metrics.push_back(SummariseMetric(*metric, rows, method, seed, purpose));
  }
  return summary;
}

}  // namespace

ScenarioSummary Summarise(const Scenario& scenario, std::span<const Row> rows, std::uint64_t seed) {
  ScenarioSummary summary{
      scenario.name, scenario.task, scenario.question, scenario.method_names, scenario.metrics, {}, {}};
  for (const Condition& condition : scenario.conditions) {
    const std::vector<const Row*> selected = RowsIn(rows, condition.settings);
    const std::vector<const MetricInfo*> metrics = MetricsIn(selected);
    ConditionSummary& part = summary.conditions.emplace_back();
    part.condition = condition.settings;
    for (std::size_t m = 0; m < scenario.method_names.size(); ++m) {
      const std::string& method = scenario.method_names[m];
      const std::string& baseline = scenario.baselines[m];
      part.methods.push_back(SummariseMethod(method, selected, metrics, scenario, condition, seed));
      if (method == baseline) continue;
      for (const std::string& id : scenario.metrics) {
        Comparison comparison = ComparePaired(PairsOf(selected, baseline, method, id), *FindMetric(id), seed,
                                              PurposeOf(scenario.name, condition.settings, id, baseline, method));
        comparison.baseline = baseline;
        comparison.method = method;
        part.comparisons.push_back(std::move(comparison));
      }
    }
  }
  for (const Expectation& expectation : scenario.expectations) {
    summary.expectations.push_back(JudgeExpectation(expectation, scenario, rows, seed));
  }
  return summary;
}

}  // namespace etude
