#include "reports/overview_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "io/drawing/escape.h"
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
  std::string interval = {};             ///< of the value, "" without
  std::string counted = {};              ///< "10 of 12" where cells have no value, else ""
  std::optional<double> sorted_by = {};  ///< the value as a number
  const Comparison* baseline = nullptr;  ///< against the baseline, where there is one
  const Comparison* rival = nullptr;     ///< against the strongest other method, where there is one

  bool IsCompared() const { return baseline != nullptr || rival != nullptr; }
};

struct OverviewRow {
  std::string method, condition;
  std::string cell = {};                 ///< one of the row's cells, a recorded one where there is one
  std::string kept = {};                 ///< its attribute, where it was recorded
  std::vector<OverviewCell> cells = {};  ///< one per metric asked for
  bool is_yardstick = false;
};

const Comparison* FindPaired(const std::vector<Comparison>& comparisons, const std::string& method,
                             const std::string& metric) {
  const auto found = std::ranges::find_if(
      comparisons, [&](const Comparison& c) { return c.method == method && c.metric == metric && c.pairs > 0; });
  return found == comparisons.end() ? nullptr : &*found;
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
  cell.baseline = FindPaired(condition.comparisons, method.method, metric);
  cell.rival = FindPaired(condition.rivals, method.method, metric);
  return cell;
}

/// Gives the headline metrics, then all others that any method has.
std::vector<std::string> AllMetricsOf(const ScenarioSummary& scenario) {
  std::vector<std::string> metrics = scenario.headline_metrics;
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const MethodSummary& method : condition.methods) {
      for (const MetricSummary& metric : method.metrics) {
        if (std::ranges::find(metrics, metric.id) == metrics.end()) metrics.push_back(metric.id);
      }
    }
  }
  return metrics;
}

/// Finds a cell of every method under every condition, a recorded one where there is one.
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

bool HasRivals(const ScenarioSummary& scenario) {
  return std::ranges::any_of(scenario.conditions, [](const ConditionSummary& c) { return !c.rivals.empty(); });
}

std::vector<OverviewRow> RowsOf(const RunData& run, const ScenarioSummary& scenario,
                                std::span<const std::string> metrics) {
  std::vector<OverviewRow> rows;
  const ExampleCells examples(run, scenario);
  // Conditions of the same method stand under each other.
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

std::string CellHtml(const OverviewCell& cell, bool is_headline, bool has_rivals, SamplingUnit unit) {
  std::string html = fmt::format("<td class=\"n{}\" data-v=\"{}\">{}", is_headline ? "" : " more",
                                 ExactText(cell.sorted_by), EscapeMarkup(cell.value));
  if (cell.IsCompared()) {
    const auto mark = [&](const Comparison* c) { return c == nullptr ? "·" : ComparisonMark(*c, unit); };
    html += fmt::format(" <span class=\"mark\">{}</span>", mark(cell.baseline));
    if (has_rivals) html += fmt::format(" <span class=\"mark\">{}</span>", mark(cell.rival));
  }
  if (!cell.interval.empty()) html += fmt::format(" <small>{}</small>", cell.interval);
  if (!cell.counted.empty()) html += fmt::format(" <small>{}</small>", cell.counted);
  return html + "</td>";
}

/// Lists which values are missing and why, those of one reason together.
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
  std::string html = "<details><summary>Missing values, and why</summary><ul class=\"reasons\">";
  std::size_t count = 0;
  for (const auto& [why, metrics] : metrics_of) {
    if (++count > kMostListed) break;
    const std::string more = metrics.size() > 1 ? fmt::format(" and {} more", metrics.size() - 1) : "";
    html += fmt::format("<li>{} <span class=\"quiet\">({}{})</span></li>", EscapeMarkup(why),
                        EscapeMarkup(metrics.front()), more);
  }
  return html + "</ul>" + LeftOutHtml(metrics_of.size(), kMostListed, "reasons", "the CSV file in report/tables") +
         "</details>";
}

constexpr std::string_view kLegend =
    "Apart: the worst joint, once headings and hips are laid onto each other. ✗: called alike, though a joint is more "
    "than 20 cm off. Beside it what the method measured: the fuzzy distance, or centimetres.";

struct PosePair {
  std::string name, gap;
  std::vector<std::string> verdicts;  ///< one per method
};

std::string VerdictOf(const Row& row) {
  const auto alike = ValueOf(row, "called_alike");
  if (!alike) return std::string(kNoValue);
  std::string text = *alike > 0 ? "alike" : "apart";
  // A joint distance where the method has one: the fuzzy distance is told of every pair.
  if (const auto joints = ValueOf(row, "joint_distance_cm")) {
    text += fmt::format(" {} cm", FormatNumber(*joints));
  } else if (const auto d = ValueOf(row, "fuzzy_distance")) {
    text += fmt::format(" {}", FormatFixed(*d, 3));
  }
  const auto is_false = ValueOf(row, "false_smooth");
  return is_false && *is_false > 0 ? "✗ " + text : text;
}

std::vector<PosePair> PairsOf(const RunData& run, const ScenarioSummary& scenario) {
  std::vector<PosePair> pairs;
  // Under a sweep, or with many pairs a world, a pair has no single verdict.
  if (scenario.task != "pose-distance" || scenario.conditions.size() != 1) return pairs;
  for (const Row& row : run.rows) {
    if (row.scenario != scenario.name) continue;
    const auto alike = ValueOf(row, "called_alike");
    if (alike && *alike > 0 && *alike < 1) return {};
    const auto method = std::ranges::find(scenario.methods, row.method);
    if (row.clip.empty() || method == scenario.methods.end()) continue;
    const bool is_first = method == scenario.methods.begin();
    if (is_first && std::ranges::find(pairs, row.clip, &PosePair::name) == pairs.end()) {
      const auto gap = ValueOf(row, "pose_gap_cm");
      pairs.push_back({row.clip, gap ? FormatNumber(*gap) + " cm" : std::string(kNoValue),
                       std::vector<std::string>(scenario.methods.size(), std::string(kNoValue))});
    }
    const auto pair = std::ranges::find(pairs, row.clip, &PosePair::name);
    if (pair == pairs.end()) continue;
    pair->verdicts[static_cast<std::size_t>(method - scenario.methods.begin())] = VerdictOf(row);
  }
  return pairs;
}

}  // namespace

std::string OverviewTableHtml(const RunData& run, const ScenarioSummary& scenario) {
  const std::vector<std::string> metrics = AllMetricsOf(scenario);
  const std::vector<OverviewRow> rows = RowsOf(run, scenario, metrics);
  if (rows.empty() || metrics.empty()) return "";
  const bool swept = scenario.conditions.size() > 1, has_rivals = HasRivals(scenario);
  const std::size_t headline = scenario.headline_metrics.size();
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Every method by every metric\"><table "
      "class=\"data glance\"><thead><tr><th scope=\"col\">Method</th>";
  if (swept) html += "<th scope=\"col\">Condition</th>";
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    const MetricWords words = WordsFor(metrics[i]);
    html += fmt::format("<th scope=\"col\" class=\"n{}\" title=\"{}\">{}{}</th>", i < headline ? "" : " more",
                        EscapeMarkup(metrics[i]), EscapeMarkup(words.label), ArrowOf(words.direction));
  }
  html += "</tr></thead><tbody>";
  for (const OverviewRow& row : std::span(rows).first(std::min(rows.size(), kMostTableRows))) {
    html +=
        fmt::format("<tr{} data-ids=\"{}\"{}><th scope=\"row\">{}</th>", row.is_yardstick ? " class=\"yardstick\"" : "",
                    EscapeMarkup(row.cell), row.kept, EscapeMarkup(row.method));
    if (swept) html += fmt::format("<td>{}</td>", EscapeMarkup(row.condition));
    for (std::size_t i = 0; i < metrics.size(); ++i)
      html += CellHtml(row.cells[i], i < headline, has_rivals, scenario.unit);
    html += "</tr>";
  }
  return html + "</tbody></table></div>" + LeftOutHtml(rows.size(), kMostTableRows, "rows", kAllNumbers) +
         MissingHtml(run, scenario);
}

std::string OverviewTableMarkdown(const ScenarioSummary& scenario) {
  if (scenario.headline_metrics.size() < 2) return "";
  const std::vector<OverviewRow> rows = RowsOf({}, scenario, scenario.headline_metrics);
  if (rows.empty()) return "";
  const bool swept = scenario.conditions.size() > 1, has_rivals = HasRivals(scenario);
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
      const auto sign = [](const Comparison* c) { return c == nullptr ? "·" : ComparisonSign(*c); };
      text += " " + EscapeMarkdown(cell.value);
      if (cell.IsCompared()) text += " " + sign(cell.baseline) + (has_rivals ? " " + sign(cell.rival) : "");
      text += " |";
    }
    text += '\n';
  }
  const std::string rest = LeftOutWords(rows.size(), kMostTableRows, "rows", kAllNumbers);
  return rest.empty() ? text : fmt::format("{}\n{}\n", text, rest);
}

std::string PosePairsHtml(const RunData& run, const ScenarioSummary& scenario) {
  const std::vector<PosePair> pairs = PairsOf(run, scenario);
  if (pairs.empty()) return "";
  std::string html =
      "<details><summary>Pair by pair</summary><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"Pair by pair\"><table class=\"data glance\"><thead><tr><th scope=\"col\">Poses</th>"
      "<th scope=\"col\" class=\"n\">Apart</th>";
  for (const std::string& method : scenario.methods) {
    html += fmt::format("<th scope=\"col\" class=\"n\">{}</th>", EscapeMarkup(method));
  }
  html += "</tr></thead><tbody>";
  for (std::size_t i = 0; i < std::min(pairs.size(), kMostListed); ++i) {
    html +=
        fmt::format("<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td>", EscapeMarkup(pairs[i].name), pairs[i].gap);
    for (const std::string& verdict : pairs[i].verdicts) html += fmt::format("<td class=\"n\">{}</td>", verdict);
    html += "</tr>";
  }
  return html + "</tbody></table></div>" + LeftOutHtml(pairs.size(), kMostListed, "pairs", "cells.jsonl") +
         fmt::format("<p class=\"quiet legend\">{}</p></details>", kLegend);
}

std::string PosePairsMarkdown(const RunData& run, const ScenarioSummary& scenario) {
  const std::vector<PosePair> pairs = PairsOf(run, scenario);
  if (pairs.empty()) return "";
  std::string head = "| poses | apart |", rule = "|---|--:|";
  for (const std::string& method : scenario.methods) {
    head += fmt::format(" {} |", EscapeMarkdown(method));
    rule += "--:|";
  }
  std::string text = fmt::format("\n{}\n{}\n", head, rule);
  for (std::size_t i = 0; i < std::min(pairs.size(), kMostListed); ++i) {
    text += fmt::format("| {} | {} |", EscapeMarkdown(pairs[i].name), pairs[i].gap);
    for (const std::string& verdict : pairs[i].verdicts) text += fmt::format(" {} |", verdict);
    text += '\n';
  }
  const std::string rest = LeftOutWords(pairs.size(), kMostListed, "pairs", "cells.jsonl");
  return fmt::format("{}\n{}{}{}\n", text, rest, rest.empty() ? "" : " ", kLegend);
}

}  // namespace etude
