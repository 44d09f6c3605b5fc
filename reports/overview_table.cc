#include "reports/overview_table.h"

#include <fmt/core.h>

#include <algorithm>

#include "reports/badge.h"
#include "reports/words/escape.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "reports/words/left_out.h"
#include "reports/words/yardstick.h"

namespace etude {
namespace {

constexpr std::string_view kAllNumbers = "the CSV file in report/tables";
constexpr std::string_view kSigns =
    "▲ better and ▼ worse than the method’s baseline, = no difference, ? inconclusive. Medians; means of shares.";

struct OverviewCell {
  std::string value;
  std::optional<Verdict> verdict;  ///< against the baseline, where there is one
};

struct OverviewRow {
  std::string method, condition;
  std::vector<OverviewCell> cells;  ///< one per headline metric
  bool is_yardstick = false;
};

OverviewCell CellOf(const ConditionSummary& condition, const MethodSummary& method, const std::string& metric) {
  OverviewCell cell{std::string(kNoValue), std::nullopt};
  const MetricWords words = WordsFor(metric);
  if (const MetricSummary* summary = FindSummary(method, metric)) {
    cell.value = FormatValue(TypicalValue(*summary, words), words);
  }
  const auto compared = std::ranges::find_if(
      condition.comparisons, [&](const Comparison& c) { return c.method == method.method && c.metric == metric; });
  if (compared != condition.comparisons.end() && compared->pairs > 0) cell.verdict = compared->verdict;
  return cell;
}

std::vector<OverviewRow> RowsOf(const ScenarioSummary& scenario) {
  std::vector<OverviewRow> rows;
  if (scenario.headline_metrics.size() < 2) return rows;
  // Conditions of the same method stand under each other.
  for (const std::string& name : scenario.methods) {
    for (const ConditionSummary& condition : scenario.conditions) {
      const auto method = std::ranges::find(condition.methods, name, &MethodSummary::method);
      if (method == condition.methods.end() || method->attempted == 0) continue;
      OverviewRow row{
          MethodLabel(scenario, name), ConditionLabel(condition.condition), {}, IsYardstick(scenario, name)};
      for (const std::string& metric : scenario.headline_metrics)
        row.cells.push_back(CellOf(condition, *method, metric));
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace

std::string OverviewTableHtml(const ScenarioSummary& scenario) {
  const std::vector<OverviewRow> rows = RowsOf(scenario);
  if (rows.empty()) return "";
  const bool swept = scenario.conditions.size() > 1;
  std::string html = fmt::format(
      "<details{}><summary>All methods at a glance</summary><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"All methods at a glance\"><table class=\"glance\"><thead><tr><th scope=\"col\">Method</th>",
      swept ? "" : " open");
  if (swept) html += "<th scope=\"col\">Condition</th>";
  for (const std::string& metric : scenario.headline_metrics) {
    const MetricWords words = WordsFor(metric);
    const std::string_view direction = DirectionWords(words.direction);
    html += fmt::format("<th scope=\"col\" class=\"n\">{}<small>{}</small></th>", EscapeMarkup(words.label), direction);
  }
  html += "</tr></thead><tbody>";
  for (const OverviewRow& row : std::span(rows).first(std::min(rows.size(), kMostTableRows))) {
    html += fmt::format("<tr{}><th scope=\"row\">{}</th>", row.is_yardstick ? " class=\"yardstick\"" : "",
                        EscapeMarkup(row.method));
    if (swept) html += fmt::format("<td>{}</td>", EscapeMarkup(row.condition));
    for (const OverviewCell& cell : row.cells) {
      const std::string sign = cell.verdict ? VerdictMark(*cell.verdict) : "";
      html += fmt::format("<td class=\"n\">{}<span class=\"mark\">{}</span></td>", EscapeMarkup(cell.value), sign);
    }
    html += "</tr>";
  }
  return html + "</tbody></table></div>" + LeftOutHtml(rows.size(), kMostTableRows, "rows", kAllNumbers) +
         fmt::format("<p class=\"quiet legend\">{}</p></details>", kSigns);
}

std::string OverviewTableMarkdown(const ScenarioSummary& scenario) {
  const std::vector<OverviewRow> rows = RowsOf(scenario);
  if (rows.empty()) return "";
  const bool swept = scenario.conditions.size() > 1;
  std::string head = "| method |", rule = "|---|";
  if (swept) head += " condition |", rule += "---|";
  for (const std::string& metric : scenario.headline_metrics) {
    head += fmt::format(" {} |", EscapeMarkdown(WordsFor(metric).label));
    rule += "--:|";
  }
  std::string text = fmt::format("\n{}\n{}\n", head, rule);
  for (const OverviewRow& row : std::span(rows).first(std::min(rows.size(), kMostTableRows))) {
    text += fmt::format("| {} |", EscapeMarkdown(row.method));
    if (swept) text += fmt::format(" {} |", EscapeMarkdown(row.condition));
    for (const OverviewCell& cell : row.cells) {
      text += fmt::format(" {}{} |", EscapeMarkdown(cell.value),
                          cell.verdict ? fmt::format(" {}", VerdictSign(cell.verdict)) : "");
    }
    text += '\n';
  }
  const std::string rest = LeftOutWords(rows.size(), kMostTableRows, "rows", kAllNumbers);
  return fmt::format("{}\n{}{}{}\n", text, rest, rest.empty() ? "" : " ", kSigns);
}

}  // namespace etude
