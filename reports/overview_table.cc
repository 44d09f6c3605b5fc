#include "reports/overview_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "io/drawing/escape.h"
#include "io/drawing/table.h"
#include "reports/badge.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

constexpr std::string_view kAllNumbers = "the CSV file in report/tables";

struct OverviewCell {
  std::string value;
  std::string interval = {};             ///< interval of `value`; "" if the value has no interval
  std::string counted = {};              ///< number of cells with a value, "10 of 12"; "" if every cell has a value
  std::optional<double> sorted_by = {};  ///< the median or mean in `value` as a number, by which the page sorts
  std::optional<Comparison> baseline = {},
                            rival = {};  ///< comparisons with the baseline and the strongest other method

  bool IsCompared() const { return baseline || rival; }
};

struct OverviewRow {
  std::string method, condition;
  std::string cell = {};  ///< ID of one of the row's cells as an example, if possible a recorded cell
  std::string kept = {};  ///< HTML attribute that links the example cell to its recording; "" without a recording
  std::vector<OverviewCell> cells = {};  ///< one table cell per metric
  bool is_yardstick = false;
};

std::optional<Comparison> FindPaired(const ConditionSummary& condition, const std::vector<Comparison>& comparisons,
                                     const std::string& method, const std::string& metric) {
  const auto found = std::ranges::find_if(
      comparisons, [&](const Comparison& c) { return c.method == method && c.metric == metric && c.pairs > 0; });
  return found == comparisons.end() ? std::nullopt : std::optional(AsAnswered(condition, *found));
}

OverviewCell CellOf(const ConditionSummary& condition, const MethodSummary& method, const std::string& metric) {
  OverviewCell cell{std::string(kNoValue)};
  const MetricWords words = WordsFor(metric);
  if (const MetricSummary* summary = FindSummary(method, metric)) {
    cell.sorted_by = TypicalValue(*summary, words);
    cell.value = FormatValue(cell.sorted_by, words);
    if (summary->ci_low) cell.interval = FormatInterval(summary->ci_low, summary->ci_high, words);
    const int all = summary->present + summary->missing;
    if (summary->missing > 0) cell.counted = fmt::format("{} of {}", FormatCount(summary->present), FormatCount(all));
  }
  cell.baseline = FindPaired(condition, condition.comparisons, method.method, metric);
  cell.rival = FindPaired(condition, condition.rivals, method.method, metric);
  return cell;
}

/// Returns the metrics of every table, then all further metrics that any method has.
std::vector<std::string> AllMetricsOf(const ScenarioSummary& scenario) {
  std::vector<std::string> metrics = TableMetrics(scenario);
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const MethodSummary& method : condition.methods) {
      for (const MetricSummary& metric : method.metrics) {
        if (std::ranges::find(metrics, metric.id) == metrics.end()) metrics.push_back(metric.id);
      }
    }
  }
  return metrics;
}

/// Finds an example cell of every method under every condition, if possible a recorded one.
class ExampleCells {
 public:
  ExampleCells(const RunData& run, const ScenarioSummary& scenario) : kept_(run) {
    for (const Row& row : run.rows) {
      if (row.scenario != scenario.name) continue;
      std::string& cell = cells_[{ConditionLabel(row.condition), row.method}];
      if (cell.empty() || (kept_.Attribute(cell).empty() && !kept_.Attribute(row.Id()).empty())) cell = row.Id();
    }
  }

  void Show(OverviewRow& row, const std::string& method) const {
    const auto found = cells_.find({row.condition, method});
    if (found == cells_.end()) return;
    row.cell = found->second;
    row.kept = kept_.Attribute(row.cell);
  }

 private:
  KeptCells kept_;
  std::map<std::pair<std::string, std::string>, std::string> cells_;
};

std::vector<OverviewRow> RowsOf(const RunData& run, const ScenarioSummary& scenario,
                                std::span<const std::string> metrics) {
  std::vector<OverviewRow> rows;
  const ExampleCells examples(run, scenario);
  // Put the rows of the same method, one per condition, below each other.
  for (const std::string& name : scenario.methods) {
    for (const ConditionSummary& condition : scenario.conditions) {
      const auto method = std::ranges::find(condition.methods, name, &MethodSummary::method);
      if (method == condition.methods.end() || method->attempted == 0) continue;
      OverviewRow row{.method = MethodLabel(scenario, name),
                      .condition = ConditionLabel(condition.condition),
                      .is_yardstick = IsYardstick(scenario, name)};
      for (const std::string& metric : metrics) row.cells.push_back(CellOf(condition, *method, metric));
      examples.Show(row, name);
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

std::string_view ArrowOf(Direction direction) {
  if (direction == Direction::kNeither) return "";
  return direction == Direction::kLowerIsBetter ? "<span role=\"img\" aria-label=\"; lower is better\">↓</span>"
                                                : "<span role=\"img\" aria-label=\"; higher is better\">↑</span>";
}

TableCell TableCellOf(const OverviewCell& cell, bool has_rivals, SamplingUnit unit) {
  std::string text = cell.value, html = EscapeMarkup(cell.value);
  if (cell.IsCompared()) {
    const auto sign = [](const std::optional<Comparison>& c) { return c ? ComparisonSign(*c) : "·"; };
    const auto mark = [&](const std::optional<Comparison>& c) { return c ? ComparisonMark(*c, unit) : "·"; };
    text += " " + sign(cell.baseline) + (has_rivals ? " " + sign(cell.rival) : "");
    html += fmt::format(" <span class=\"mark\">{}</span>", mark(cell.baseline));
    if (has_rivals) html += fmt::format(" <span class=\"mark\">{}</span>", mark(cell.rival));
  }
  if (!cell.interval.empty()) html += fmt::format(" <small>{}</small>", cell.interval);
  if (!cell.counted.empty()) html += fmt::format(" <small>{}</small>", cell.counted);
  return {text, cell.sorted_by, html};
}

/// Returns a table with one row per method and condition and one column for each metric in `metrics`. Those of
/// TableMetrics come first; the other columns are marked as details.
Table OverviewTable(const ScenarioSummary& scenario, std::span<const std::string> metrics,
                    std::span<const OverviewRow> rows, std::string_view method_head, std::string_view condition_head) {
  const bool swept = scenario.conditions.size() > 1;
  const std::size_t shown = TableMetrics(scenario).size();
  const bool has_rivals =
      std::ranges::any_of(scenario.conditions, [](const ConditionSummary& c) { return !c.rivals.empty(); });
  Table table{.label = "All metrics of all methods",
              .style = "data glance",
              .columns = {{.head = std::string(method_head), .is_row_head = true}}};
  if (swept) table.columns.push_back({std::string(condition_head)});
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    const MetricWords words = WordsFor(metrics[i]);
    table.columns.push_back({.head = words.label,
                             .is_number = true,
                             .is_detail = i >= shown,
                             .is_sortable = true,
                             .title = metrics[i],
                             .sign = std::string(ArrowOf(words.direction))});
  }
  for (const OverviewRow& row : rows.first(std::min(rows.size(), kMaxTableRows))) {
    TableRow made{.cells = {row.method},
                  .attributes = fmt::format("{} data-ids=\"{}\"{}", row.is_yardstick ? " class=\"yardstick\"" : "",
                                            EscapeMarkup(row.cell), row.kept)};
    if (swept) made.cells.emplace_back(row.condition);
    for (const OverviewCell& cell : row.cells) made.cells.push_back(TableCellOf(cell, has_rivals, scenario.unit));
    table.rows.push_back(std::move(made));
  }
  return table;
}

/// Returns a list that states how many values are missing, for each reason.
std::string MissingHtml(const RunData& run, const ScenarioSummary& scenario) {
  std::map<std::string, std::vector<std::string>> metrics_of;
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const MethodSummary& method : condition.methods) {
      for (const MetricSummary& metric : method.metrics) {
        if (metric.missing == 0) continue;
        const std::string label = ConditionLabel(condition.condition);
        metrics_of[fmt::format("{}{}{}, {} of {}: {}", method.method, label.empty() ? "" : ", ", label, metric.missing,
                               metric.missing + metric.present,
                               MissingReasons(run, scenario.name, condition.condition, method.method, metric.id))]
            .push_back(WordsFor(metric.id).label);
      }
    }
  }
  if (metrics_of.empty()) return "";
  std::string html = "<details><summary>Missing values and their reasons</summary><ul class=\"reasons\">";
  std::size_t count = 0;
  for (const auto& [why, metrics] : metrics_of) {
    if (++count > kMaxListed) break;
    const std::string more = metrics.size() > 1 ? fmt::format(" and {} more", metrics.size() - 1) : "";
    html += fmt::format("<li>{} <span class=\"quiet\">({}{})</span></li>", EscapeMarkup(why),
                        EscapeMarkup(metrics.front()), more);
  }
  return html + "</ul>" + LeftOutHtml(metrics_of.size(), kMaxListed, "reasons", "the CSV file in report/tables") +
         "</details>";
}

constexpr std::string_view kLegend =
    "“Apart” is the distance of the worst joint after headings and hips are aligned. ✗ marks a pair that the method "
    "called alike, although a joint is more than 20 cm away. The number after “alike” or “apart” is the distance that "
    "the method measured: a fuzzy distance, or centimetres.";

std::string VerdictOf(const Row& row) {
  const auto alike = ValueOf(row, "called_alike");
  if (!alike) return std::string(kNoValue);
  std::string text = *alike > 0 ? "alike" : "apart";
  // Show the distance between the joints if the method uses it; otherwise show the fuzzy distance, which exists for
  // every pair of poses.
  if (const auto joints = ValueOf(row, "joint_distance_cm")) {
    text += fmt::format(" {} cm", FormatNumber(*joints));
  } else if (const auto d = ValueOf(row, "fuzzy_distance")) {
    text += fmt::format(" {}", FormatFixed(*d, 3));
  }
  const auto is_false = ValueOf(row, "false_smooth");
  return is_false && *is_false > 0 ? "✗ " + text : text;
}

/// Returns a table with one row for every pair of poses, which shows each method's verdict. The table has no rows if a
/// parameter is swept or a world has several pairs: a pair then has no single verdict.
Table PosePairs(const RunData& run, const ScenarioSummary& scenario, std::string_view poses, std::string_view apart) {
  Table table{
      .label = "Pair by pair",
      .style = "data glance",
      .columns = {{.head = std::string(poses), .is_row_head = true}, {.head = std::string(apart), .is_number = true}}};
  for (const std::string& method : scenario.methods) table.columns.push_back({.head = method, .is_number = true});
  if (scenario.task != "pose-distance" || scenario.conditions.size() != 1) return table;
  // Read the pairs from the first method's rows, and the verdicts from every method's rows.
  for (const Row& row : run.rows) {
    if (row.scenario != scenario.name) continue;
    const auto alike = ValueOf(row, "called_alike");
    if (alike && *alike > 0 && *alike < 1) return {};
    const auto method = std::ranges::find(scenario.methods, row.method);
    if (row.clip.empty() || method == scenario.methods.end()) continue;
    const auto find = [&] {
      return std::ranges::find(table.rows, row.clip, [](const TableRow& pair) { return pair.cells[0].text; });
    };
    if (method == scenario.methods.begin() && find() == table.rows.end()) {
      const auto gap = ValueOf(row, "pose_gap_cm");
      table.rows.push_back({std::vector<TableCell>(table.columns.size(), kNoValue)});
      table.rows.back().cells[0] = row.clip;
      if (gap) table.rows.back().cells[1] = FormatNumber(*gap) + " cm";
    }
    const auto pair = find();
    if (pair == table.rows.end()) continue;
    pair->cells[2 + static_cast<std::size_t>(method - scenario.methods.begin())] = VerdictOf(row);
  }
  return table;
}

}  // namespace

std::string OverviewTableHtml(const RunData& run, const ScenarioSummary& scenario) {
  const std::vector<std::string> metrics = AllMetricsOf(scenario);
  const std::vector<OverviewRow> rows = RowsOf(run, scenario, metrics);
  if (rows.empty() || metrics.empty()) return "";
  return TableHtml(OverviewTable(scenario, metrics, rows, "Method", "Condition")) +
         LeftOutHtml(rows.size(), kMaxTableRows, "rows", kAllNumbers) + MissingHtml(run, scenario);
}

std::string OverviewTableMarkdown(const ScenarioSummary& scenario) {
  if (scenario.headline_metrics.size() < 2) return "";
  const std::vector<std::string> metrics = TableMetrics(scenario);
  const std::vector<OverviewRow> rows = RowsOf({}, scenario, metrics);
  if (rows.empty()) return "";
  const std::string text = TableMarkdown(OverviewTable(scenario, metrics, rows, "method", "condition"));
  const std::string rest = LeftOutWords(rows.size(), kMaxTableRows, "rows", kAllNumbers);
  return rest.empty() ? text : fmt::format("{}\n{}\n", text, rest);
}

std::string PosePairsHtml(const RunData& run, const ScenarioSummary& scenario) {
  Table pairs = PosePairs(run, scenario, "Poses", "Apart");
  const std::size_t all = pairs.rows.size();
  if (all == 0) return "";
  pairs.rows.resize(std::min(all, kMaxListed));
  return fmt::format("<details><summary>Pair by pair</summary>{}{}<p class=\"quiet legend\">{}</p></details>",
                     TableHtml(pairs), LeftOutHtml(all, kMaxListed, "pairs", "cells.jsonl"), kLegend);
}

std::string PosePairsMarkdown(const RunData& run, const ScenarioSummary& scenario) {
  Table pairs = PosePairs(run, scenario, "poses", "apart");
  const std::size_t all = pairs.rows.size();
  if (all == 0) return "";
  pairs.rows.resize(std::min(all, kMaxListed));
  const std::string rest = LeftOutWords(all, kMaxListed, "pairs", "cells.jsonl");
  return fmt::format("{}\n{}{}{}\n", TableMarkdown(pairs), rest, rest.empty() ? "" : " ", kLegend);
}

}  // namespace etude
