#include "reports/number_table.h"

#include <fmt/core.h>

#include "reports/words/escape.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

std::string MissingText(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition,
                        const MethodSummary& method, const MetricSummary& metric) {
  if (metric.missing == 0) return "";
  return MissingReasons(run, scenario.name, condition.condition, method.method, metric.id);
}

}  // namespace

std::string NumberTableCsv(const RunData& run, const ScenarioSummary& scenario) {
  std::string csv =
      "scenario,condition,method,metric,unit_label,median,ci95_low,ci95_high,mean,present,missing,missing_why,"
      "interval\n";
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const MethodSummary& method : condition.methods) {
      if (method.attempted > 0) {
        csv += fmt::format("{},{},{},ok_share,,,{},{},{},{},0,,wilson\n", EscapeCsv(scenario.name),
                           EscapeCsv(ConditionLabel(condition.condition)), EscapeCsv(method.method),
                           ExactText(method.ok_low), ExactText(method.ok_high),
                           static_cast<double>(method.ok) / method.attempted, method.attempted);
      }
      for (const MetricSummary& metric : method.metrics) {
        const MetricInfo* info = FindMetric(metric.id);
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", EscapeCsv(scenario.name),
                           EscapeCsv(ConditionLabel(condition.condition)), EscapeCsv(method.method),
                           EscapeCsv(metric.id), EscapeCsv(info == nullptr ? "" : info->unit), ExactText(metric.median),
                           ExactText(metric.ci_low), ExactText(metric.ci_high), ExactText(metric.mean), metric.present,
                           metric.missing, EscapeCsv(MissingText(run, scenario, condition, method, metric)),
                           IntervalKindName(metric.interval));
      }
    }
  }
  return csv;
}

}  // namespace etude
