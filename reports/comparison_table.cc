#include "reports/comparison_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "reports/badge.h"
#include "reports/words/escape.h"
#include "reports/words/figures.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

// Where all comparisons are that a page has no room for.
constexpr std::string_view kAllComparisons = "the CSV file of comparisons in report/tables";

/// One comparison as the texts of its cells, not yet escaped.
struct Line {
  std::string condition, metric, methods, pairs, difference, interval, p, effect, beyond, notes;
};

int Worlds(const Comparison& c) { return c.pairs + c.only_baseline + c.only_method + c.neither; }

std::string EffectText(const Comparison& c) {
  if (!c.effect_size) return std::string(kNoValue);
  const std::string size = FormatFixed(*c.effect_size, 2);
  return *c.effect_size > 0 ? "+" + size : size;
}

std::string Notes(const Comparison& c) {
  std::string text = c.why_open;
  for (const std::string& note : c.notes) text += (text.empty() ? "" : "; ") + note;
  return text;
}

std::string BothNotes(const Comparison& c, SamplingUnit unit) {
  std::string text = Notes(c);
  // Where worlds are the units, the same has been said of them.
  if (c.beyond.why_open.empty() || IsEveryWorldItsOwn(unit)) return text;
  return text + fmt::format("{}for {}: {}", text.empty() ? "" : "; ", OtherUnits(unit), c.beyond.why_open);
}

Line LineOf(const ConditionSummary& condition, const Comparison& c, SamplingUnit unit) {
  const MetricWords words = WordsFor(c.metric);
  Line line;
  line.condition = ConditionLabel(condition.condition);
  line.metric = MetricHeading(c.metric);
  line.methods = fmt::format("{} − {}", c.method, c.baseline);
  line.pairs = Worlds(c) == c.pairs ? FormatCount(c.pairs)
                                    : fmt::format("{} of {}", FormatCount(c.pairs), FormatCount(Worlds(c)));
  line.difference = c.difference ? ShortDifference(*c.difference, words) : std::string(kNoValue);
  line.interval = FormatInterval(c.ci_low, c.ci_high, words);
  if (c.interval == IntervalKind::kPercentile && c.differing > 0) line.interval += " †";
  line.p = FormatP(c.p_holm);
  line.effect = EffectText(c);
  line.beyond = ShortBeyond(c, unit);
  line.notes = BothNotes(c, unit);
  return line;
}

/// Writes the figures as a row, and below them over the whole width the notes.
std::string RowHtml(const Line& line, const Comparison& c, bool swept, int columns) {
  std::string html =
      fmt::format("<tr{}><td>{}</td>", line.notes.empty() ? "" : " class=\"noted\"", EscapeMarkup(line.methods));
  if (swept) html += fmt::format("<td>{}</td>", EscapeMarkup(line.condition));
  for (const std::string& figure : {line.pairs, line.difference, line.interval, line.p, line.effect}) {
    html += fmt::format("<td class=\"n\">{}</td>", EscapeMarkup(figure));
  }
  const auto& beyond = c.beyond.verdict;
  html += fmt::format("<td>{}</td><td>{}</td></tr>", VerdictBadge(c.verdict),
                      beyond ? VerdictBadge(*beyond) : EscapeMarkup(line.beyond));
  if (line.notes.empty()) return html;
  return html + fmt::format("<tr class=\"note\"><td colspan=\"{}\">{}</td></tr>", columns, EscapeMarkup(line.notes));
}

std::string Legend(const ScenarioSummary& scenario) {
  return fmt::format(
      "Difference: method − baseline in the same world, the median (of shares and penalised costs the mean); its 95 % "
      "interval is a BCa bootstrap (of shares adjusted Wald; †: percentile, where BCa is undefined). p: Wilcoxon’s "
      "signed ranks (where the mean counts, sign flips), corrected over this scenario’s {} (Holm). Effect: "
      "rank-biserial "
      "correlation, −1 to +1, + is better. Better or worse: p ≤ 0.05, an interval on one side of zero, and a "
      "difference that matters. No difference: the interval within what matters. Where one method alone failed, p "
      "counts that world as its loss, and the verdict must hold with and without. For {}: the mean over {} of their "
      "own mean "
      "differences decides, however many worlds each gave; with fewer than 6 there is no such verdict.",
      Plural(scenario.family, "comparison"), OtherUnits(scenario.unit), TheseUnits(scenario.unit));
}

std::string BeyondCsv(const Beyond& beyond) {
  return fmt::format("{},{},{},{},{},{},{},{},{}\n", beyond.units, ExactText(beyond.difference), ExactText(beyond.low),
                     ExactText(beyond.high), ExactText(beyond.test.p), EscapeCsv(beyond.test.how), ExactText(beyond.p_holm),
                     beyond.verdict ? VerdictName(*beyond.verdict) : "", EscapeCsv(beyond.why_open));
}

/// Visits every condition's comparisons with baselines, then those with the strongest other method.
template <typename Visit>
void ForEachComparison(const ScenarioSummary& scenario, Visit visit) {
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const Comparison& c : condition.comparisons) visit(condition, c, Against::kBaseline);
    for (const Comparison& c : condition.rivals) visit(condition, c, Against::kRival);
  }
}

std::size_t CountOf(const ScenarioSummary& scenario) {
  std::size_t count = 0;
  for (const ConditionSummary& condition : scenario.conditions) {
    count += condition.comparisons.size() + condition.rivals.size();
  }
  return count;
}

/// Says "holds", or why no common verdict counts.
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

/// Writes one condition's difference: "3.10 pp better".
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

std::string ShortDifference(double difference, const MetricWords& words) {
  return FormatNumber(difference * words.scale) + (words.is_share ? " pp" : words.difference_suffix);
}

std::string MetricHeading(const std::string& metric) {
  const MetricWords words = WordsFor(metric);
  const MetricInfo* info = FindMetric(metric);
  if (info == nullptr) return words.label;
  const std::string matters =
      fmt::format("{:g}{}", info->practical * words.scale, words.is_share ? " pp" : words.difference_suffix);
  const std::string_view direction = DirectionWords(info->direction);
  return fmt::format("{} ({}{}{} matters)", words.label, direction, direction.empty() ? "" : ", ", matters);
}

std::string ComparisonTableHtml(const ScenarioSummary& scenario) {
  if (CountOf(scenario) == 0) return "";
  const bool swept = scenario.conditions.size() > 1;
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Every comparison\"><table><thead><tr>"
      "<th scope=\"col\">Methods</th>";
  if (swept) html += "<th scope=\"col\">Condition</th>";
  for (const char* head : {"Pairs", "Difference", "95 % interval", "p (Holm)", "Effect"}) {
    html += fmt::format("<th scope=\"col\" class=\"n\">{}</th>", head);
  }
  html += fmt::format("<th scope=\"col\">On {}</th><th scope=\"col\">For {}</th></tr></thead>",
                      TheseUnits(scenario.unit), OtherUnits(scenario.unit));
  const int columns = swept ? 9 : 8;
  std::size_t rows = 0;
  const auto add_group = [&](const std::string& metric, Against against) {
    std::string group;
    // Conditions of the same methods stand under each other.
    for (const std::string& method : scenario.methods) {
      for (const Judged& j : JudgedOf(scenario, method, metric, against)) {
        if (++rows > kMostTableRows) continue;
        group += RowHtml(LineOf(*j.condition, *j.comparison, scenario.unit), *j.comparison, swept, columns);
      }
    }
    if (group.empty()) return;
    html += fmt::format("<tbody><tr class=\"group\"><th scope=\"rowgroup\" colspan=\"{}\">{}{}</th></tr>{}</tbody>",
                        columns, EscapeMarkup(MetricHeading(metric)),
                        against == Against::kRival ? ", against the strongest other method" : "", group);
  };
  for (const Against against : {Against::kBaseline, Against::kRival}) {
    for (const std::string& metric : scenario.headline_metrics) add_group(metric, against);
  }
  return html + "</table></div>" + LeftOutHtml(rows, kMostTableRows, "comparisons", kAllComparisons) +
         fmt::format("<p class=\"quiet legend\">{}</p>", EscapeMarkup(Legend(scenario)));
}

std::string ComparisonTableMarkdown(const ScenarioSummary& scenario) {
  const std::size_t count = CountOf(scenario);
  if (count == 0) return "";
  std::string text = fmt::format(
      "\n<details><summary>Every comparison ({})</summary>\n\n"
      "| metric | methods | condition | pairs | difference (95 % interval) | p (Holm) | effect | on {} | for {} | mind "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      count, TheseUnits(scenario.unit), OtherUnits(scenario.unit));
  std::size_t rows = 0;
  ForEachComparison(scenario, [&](const ConditionSummary& condition, const Comparison& c, Against against) {
    if (++rows > kMostTableRows) return;
    const Line line = LineOf(condition, c, scenario.unit);
    text +=
        fmt::format("| {} | {}{} | {} | {} | {} ({}) | {} | {} | {} | {} | {} |\n", EscapeMarkdown(line.metric),
                    EscapeMarkdown(line.methods), against == Against::kRival ? " (strongest other)" : "",
                    EscapeMarkdown(line.condition), line.pairs, line.difference, line.interval, EscapeMarkdown(line.p),
                    line.effect, VerdictName(c.verdict), line.beyond, EscapeMarkdown(line.notes));
  });
  const std::string rest = LeftOutWords(rows, kMostTableRows, "comparisons", kAllComparisons);
  if (!rest.empty()) text += fmt::format("\n{}\n", EscapeMarkdown(rest));
  return text + fmt::format("\n{}\n\n</details>\n", EscapeMarkdown(Legend(scenario)));
}

std::string ComparisonTableCsv(const ScenarioSummary& scenario) {
  std::string csv =
      "scenario,condition,metric,baseline,method,pairs,differing,only_baseline,only_method,neither,difference,ci95_low,"
      "ci95_high,interval,mean_difference,mean_ci95_low,mean_ci95_high,p_signed_rank,signed_rank_how,p_sign_flip,"
      "sign_flip_how,p_holm,effect_size,share_better,verdict,notes,against,unit,units,beyond_mean,beyond_ci95_low,"
      "beyond_ci95_high,beyond_p,beyond_how,beyond_p_holm,beyond_verdict,beyond_why_open\n";
  ForEachComparison(scenario, [&](const ConditionSummary& condition, const Comparison& c, Against against) {
    csv += fmt::format("{},{},{},{},{},", EscapeCsv(scenario.name), EscapeCsv(ConditionLabel(condition.condition)),
                       EscapeCsv(c.metric), EscapeCsv(c.baseline), EscapeCsv(c.method));
    csv += fmt::format("{},{},{},{},{},", c.pairs, c.differing, c.only_baseline, c.only_method, c.neither);
    csv += fmt::format("{},{},{},{},{},{},{},", ExactText(c.difference), ExactText(c.ci_low), ExactText(c.ci_high),
                       IntervalKindName(c.interval), ExactText(c.mean), ExactText(c.mean_low), ExactText(c.mean_high));
    csv += fmt::format("{},{},{},{},{},", ExactText(c.signed_rank.p), EscapeCsv(c.signed_rank.how), ExactText(c.sign_flip.p),
                       EscapeCsv(c.sign_flip.how), ExactText(c.p_holm));
    csv += fmt::format("{},{},{},{},", ExactText(c.effect_size),
                       ExactText(c.pairs > 0 ? std::optional(c.share_better) : std::nullopt), VerdictName(c.verdict),
                       EscapeCsv(Notes(c)));
    csv += fmt::format("{},{},", against == Against::kRival ? "rival" : "baseline", SamplingUnitName(scenario.unit));
    csv += BeyondCsv(c.beyond);
  });
  return csv;
}

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
