#include "reports/overview_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <vector>

#include "reports/badge.h"
#include "reports/words/escape.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

constexpr std::string_view kAllNumbers = "the CSV file in report/tables";
constexpr std::string_view kSigns =
    "First sign: against the method’s baseline; second: against the strongest other method. ▲ better, ▼ worse, = no "
    "difference that matters, ? undecided, · not compared; in brackets on these worlds only, not for other clips, "
    "people "
    "or libraries. Medians; means of shares, scores and penalised costs.";

struct OverviewCell {
  std::string value;
  const Comparison* baseline = nullptr;  ///< against the baseline, where there is one
  const Comparison* rival = nullptr;     ///< against the strongest other method, where there is one

  bool IsCompared() const { return baseline != nullptr || rival != nullptr; }
};

struct OverviewRow {
  std::string method, condition;
  std::vector<OverviewCell> cells;  ///< one per headline metric
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
    cell.value = FormatValue(TypicalValue(*summary, words), words);
  }
  cell.baseline = FindPaired(condition.comparisons, method.method, metric);
  cell.rival = FindPaired(condition.rivals, method.method, metric);
  return cell;
}

bool HasRivals(const ScenarioSummary& scenario) {
  return std::ranges::any_of(scenario.conditions, [](const ConditionSummary& c) { return !c.rivals.empty(); });
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

std::string OverviewTableHtml(const ScenarioSummary& scenario) {
  const std::vector<OverviewRow> rows = RowsOf(scenario);
  if (rows.empty()) return "";
  const bool swept = scenario.conditions.size() > 1, has_rivals = HasRivals(scenario);
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
      const auto mark = [&](const Comparison* c) { return c == nullptr ? "·" : ComparisonMark(*c, scenario.unit); };
      html += fmt::format("<td class=\"n\">{}<span class=\"mark\">{}</span>", EscapeMarkup(cell.value),
                          cell.IsCompared() ? mark(cell.baseline) : "");
      if (has_rivals) html += fmt::format("<span class=\"mark\">{}</span>", cell.IsCompared() ? mark(cell.rival) : "");
      html += "</td>";
    }
    html += "</tr>";
  }
  return html + "</tbody></table></div>" + LeftOutHtml(rows.size(), kMostTableRows, "rows", kAllNumbers) +
         fmt::format("<p class=\"quiet legend\">{}</p></details>", kSigns);
}

std::string OverviewTableMarkdown(const ScenarioSummary& scenario) {
  const std::vector<OverviewRow> rows = RowsOf(scenario);
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
  return fmt::format("{}\n{}{}{}\n", text, rest, rest.empty() ? "" : " ", kSigns);
}

std::string PosePairsHtml(const RunData& run, const ScenarioSummary& scenario) {
  const std::vector<PosePair> pairs = PairsOf(run, scenario);
  if (pairs.empty()) return "";
  std::string html =
      "<details open><summary>Pair by pair</summary><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"Pair by pair\"><table class=\"glance\"><thead><tr><th scope=\"col\">Poses</th>"
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
