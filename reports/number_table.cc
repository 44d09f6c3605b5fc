#include "reports/number_table.h"

#include <fmt/core.h>

#include "reports/words/escape.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

/// The words of a share that is no metric of the catalogue.
const MetricWords kShare{.label = "", .suffix = " %", .difference_suffix = "", .scale = 100, .is_share = true};

std::string Cell(std::string_view html) { return fmt::format("<td>{}</td>", html); }
std::string NumberCell(std::string_view html) { return fmt::format("<td class=\"n\">{}</td>", html); }

std::string MissingText(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition,
                        const MethodSummary& method, const MetricSummary& metric) {
  if (metric.missing == 0) return "";
  return MissingReasons(run, scenario.name, condition.condition, method.method, metric.id);
}

std::string OkCells(const ScenarioSummary& scenario, const MethodSummary& method) {
  return Cell("<span title=\"ok_share\">cells that ended ok</span>") +
         Cell(EscapeMarkup(MethodLabel(scenario, method.method))) + NumberCell(kNoValue) +
         NumberCell(FormatInterval(method.ok_low, method.ok_high, kShare)) +
         NumberCell(FormatShare(method.ok, method.attempted)) + NumberCell(FormatCount(method.attempted)) + Cell("");
}

std::string MetricCells(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition,
                        const MethodSummary& method, const MetricSummary& metric) {
  const MetricWords words = WordsFor(metric.id);
  const std::string missing = metric.missing == 0
                                  ? ""
                                  : fmt::format("{} of {}: {}", metric.missing, metric.missing + metric.present,
                                                EscapeMarkup(MissingText(run, scenario, condition, method, metric)));
  return Cell(fmt::format("<span title=\"{}\">{}</span>", EscapeMarkup(metric.id), EscapeMarkup(words.label))) +
         Cell(EscapeMarkup(MethodLabel(scenario, method.method))) + NumberCell(FormatValue(metric.median, words)) +
         NumberCell(FormatInterval(metric.ci_low, metric.ci_high, words)) +
         NumberCell(FormatValue(metric.mean, words)) + NumberCell(FormatCount(metric.present)) + Cell(missing);
}

}  // namespace

std::string NumberTableHtml(const RunData& run, const ScenarioSummary& scenario) {
  const bool swept = scenario.conditions.size() > 1;
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"All numbers\"><table><thead><tr>";
  if (swept) html += "<th scope=\"col\">Condition</th>";
  html +=
      "<th scope=\"col\">Metric</th><th scope=\"col\">Method</th><th scope=\"col\" class=\"n\">Median</th>"
      "<th scope=\"col\" class=\"n\">95 % interval</th><th scope=\"col\" class=\"n\">Mean</th>"
      "<th scope=\"col\" class=\"n\">Values</th><th scope=\"col\">Missing, and why</th></tr></thead><tbody>";
  std::size_t rows = 0;
  // The text of a row is made only while there is room for it.
  const auto add = [&](const ConditionSummary& condition, const std::string& method, const auto& figures) {
    if (++rows > kMostTableRows) return;
    html += IsYardstick(scenario, method) ? "<tr class=\"yardstick\">" : "<tr>";
    if (swept) html += Cell(EscapeMarkup(ConditionLabel(condition.condition)));
    html += figures() + "</tr>";
  };
  for (const ConditionSummary& condition : scenario.conditions) {
    if (condition.methods.empty()) continue;
    for (const MethodSummary& method : condition.methods) {
      if (method.attempted == 0) continue;
      add(condition, method.method, [&] { return OkCells(scenario, method); });
    }
    // Grouped by metric, so that methods stand under each other.
    for (const MetricSummary& first : condition.methods.front().metrics) {
      for (const MethodSummary& method : condition.methods) {
        const MetricSummary* metric = FindSummary(method, first.id);
        if (metric == nullptr) continue;
        add(condition, method.method, [&] { return MetricCells(run, scenario, condition, method, *metric); });
      }
    }
  }
  return html + "</tbody></table></div>" + LeftOutHtml(rows, kMostTableRows, "rows", "the CSV file in report/tables");
}

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
