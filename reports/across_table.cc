#include "reports/across_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "reports/badge.h"
#include "reports/comparison_table.h"
#include "reports/words/escape.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

/// "holds", or why no verdict counts: where it says something else, or nothing.
std::string WhatHolds(const AcrossVerdict& across) {
  if (across.Holds()) return "holds";
  std::vector<Verdict> said;
  for (const AcrossVerdict::Each& each : across.each) {
    if (std::ranges::find(said, each.verdict) == said.end()) said.push_back(each.verdict);
  }
  if (said.size() == 1) return "inconclusive everywhere";
  const auto says = [&](Verdict verdict) { return std::ranges::find(said, verdict) != said.end(); };
  return says(Verdict::kBetter) && says(Verdict::kWorse) ? "turns round" : "does not hold everywhere";
}

std::string MethodsOf(const AcrossVerdict& across) { return across.method + " − " + across.baseline; }

/// "3.10 pp better"
std::string EachText(const AcrossVerdict& across, const AcrossVerdict::Each& each) {
  if (!each.difference) return std::string(VerdictName(each.verdict));
  const MetricWords words = WordsFor(across.metric);
  return fmt::format("{} {}", ShortDifference(*each.difference, words), VerdictName(each.verdict));
}

std::vector<std::string> HeadingsOf(const ScenarioSummary& scenario) {
  std::vector<std::string> headings = {"metric", "methods", "condition"};
  for (const AcrossVerdict::Each& each : scenario.across.front().each) headings.push_back(each.value);
  headings.emplace_back("under all");
  return headings;
}

std::vector<std::string> CellsOf(const AcrossVerdict& across) {
  std::vector<std::string> cells = {across.metric, MethodsOf(across), ConditionLabel(across.condition)};
  for (const AcrossVerdict::Each& each : across.each) cells.push_back(EachText(across, each));
  return cells;
}

}  // namespace

std::string AcrossTableHtml(const ScenarioSummary& scenario) {
  if (scenario.across.empty()) return "";
  std::string html =
      "<h3>What holds under all of them</h3><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"What holds under all\"><table><thead><tr>";
  for (const std::string& heading : HeadingsOf(scenario)) {
    html += fmt::format("<th scope=\"col\">{}</th>", EscapeMarkup(heading));
  }
  html += "</tr></thead><tbody>";
  for (const AcrossVerdict& across : scenario.across) {
    html += "<tr>";
    for (const std::string& cell : CellsOf(across)) html += fmt::format("<td>{}</td>", EscapeMarkup(cell));
    html += fmt::format("<td>{} {}</td></tr>", VerdictBadge(across.verdict), WhatHolds(across));
  }
  return html + "</tbody></table></div>";
}

std::string AcrossTableMarkdown(const ScenarioSummary& scenario) {
  if (scenario.across.empty()) return "";
  std::string text = "\nA verdict counts only when it is the same under all of them:\n\n|", rule = "\n|";
  for (const std::string& heading : HeadingsOf(scenario)) {
    text += fmt::format(" {} |", EscapeMarkdown(heading));
    rule += "---|";
  }
  text += rule + '\n';
  for (const AcrossVerdict& across : scenario.across) {
    text += "|";
    for (const std::string& cell : CellsOf(across)) text += fmt::format(" {} |", EscapeMarkdown(cell));
    text += fmt::format(" {}: {} |\n", VerdictName(across.verdict), WhatHolds(across));
  }
  return text;
}

}  // namespace etude
