#include "reports/comparison_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "engine/base/csv.h"
#include "io/drawing/escape.h"
#include "reports/badge.h"
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

/// A comparison that is shown, and the condition that it was made under.
struct Shown {
  const ConditionSummary* condition;
  const Comparison* comparison;
  Against against;
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

/// Writes one comparison as a row. What only experts look for is marked "more": the page's script shows it when asked.
std::string RowHtml(const ScenarioSummary& scenario, const Shown& shown, bool swept) {
  const Comparison& c = *shown.comparison;
  const Line line = LineOf(*shown.condition, c, scenario.unit);
  const std::string place = fmt::format("{}/{}/000/", scenario.name, CompactLabel(shown.condition->condition));
  std::string cells = place + c.method;  // those of the first trial, to begin with
  for (const std::string& baseline : BaselinesOf({&c, shown.condition})) cells += "\n" + place + baseline;
  std::string html = fmt::format("<tr data-ids=\"{}\"><td>{}</td>", EscapeMarkup(cells), EscapeMarkup(line.methods));
  if (swept) html += fmt::format("<td>{}</td>", EscapeMarkup(line.condition));
  const auto number = [&](const std::string& text, std::optional<double> value, const char* style = "n") {
    html += fmt::format("<td class=\"{}\" data-v=\"{}\">{}</td>", style, ExactText(value), EscapeMarkup(text));
  };
  number(line.difference, c.difference);
  number(line.interval, c.ci_low);
  const auto& beyond = c.beyond.verdict;
  html += fmt::format("<td>{}</td><td>{}</td>", VerdictBadge(c.verdict),
                      beyond ? VerdictBadge(*beyond) : std::string(kNoValue));
  number(line.pairs, c.pairs, "n more");
  number(line.p, c.p_holm, "n more");
  number(line.effect, c.effect_size, "n more");
  return html + fmt::format("<td class=\"more\">{}</td></tr>", EscapeMarkup(line.notes));
}

std::string Legend(const ScenarioSummary& scenario) {
  return fmt::format("p is corrected over this scenario’s {} (Holm).", Plural(scenario.family, "comparison"));
}

std::string BeyondCsv(const Beyond& beyond) {
  return fmt::format("{},{},{},{},{},{},{},{},{}\n", beyond.units, ExactText(beyond.difference), ExactText(beyond.low),
                     ExactText(beyond.high), ExactText(beyond.test.p), CsvText(beyond.test.how),
                     ExactText(beyond.p_holm), beyond.verdict ? VerdictName(*beyond.verdict) : "",
                     CsvText(beyond.why_open));
}

/// Visits every condition's comparisons with baselines, then those with the strongest other method.
template <typename Visit>
void ForEachComparison(const ScenarioSummary& scenario, Visit visit) {
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const Comparison& c : condition.comparisons) visit(condition, c, Against::kBaseline);
    for (const Comparison& c : condition.rivals) visit(condition, c, Against::kRival);
  }
}

/// Gives every comparison once: those with the strongest other method leave out pairs that were compared already,
/// whichever way round. In the order of metrics, methods, conditions.
std::vector<Shown> DistinctOf(const ScenarioSummary& scenario) {
  std::vector<Shown> all;
  ForEachComparison(scenario, [&](const ConditionSummary& condition, const Comparison& c, Against against) {
    all.push_back({&condition, &c, against});
  });
  std::ranges::stable_sort(all, {}, [](const Shown& shown) { return shown.against; });
  std::set<std::tuple<const ConditionSummary*, std::string, std::string, std::string>> seen;
  std::erase_if(all, [&](const Shown& shown) {
    const auto [first, second] = std::minmax(shown.comparison->method, shown.comparison->baseline);
    return !seen.insert({shown.condition, shown.comparison->metric, first, second}).second;
  });
  const auto place = [](const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) - names.begin();
  };
  std::ranges::stable_sort(all, {}, [&](const Shown& shown) {
    return std::tuple(place(scenario.headline_metrics, shown.comparison->metric), shown.against,
                      place(scenario.methods, shown.comparison->method));
  });
  return all;
}

/// Writes comparisons as a table, a body per metric. `left` rows may be written at most, and are counted down.
std::string TableHtml(const ScenarioSummary& scenario, std::span<const Shown> shown, std::size_t& left) {
  const bool swept = scenario.conditions.size() > 1;
  std::string html =
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Comparisons\"><table class=\"data\"><thead>"
      "<tr><th scope=\"col\">Methods</th>";
  if (swept) html += "<th scope=\"col\">Condition</th>";
  html += fmt::format(
      "<th scope=\"col\" class=\"n\">Difference</th><th scope=\"col\" class=\"n\">95 % interval</th>"
      "<th scope=\"col\">On {}</th><th scope=\"col\">For {}</th>",
      TheseUnits(scenario.unit), OtherUnits(scenario.unit));
  for (const char* head : {"Worlds", "p (Holm)", "Effect"}) {
    html += fmt::format("<th scope=\"col\" class=\"n more\">{}</th>", head);
  }
  html += "<th scope=\"col\" class=\"more\">Mind</th></tr></thead>";
  const std::string* metric = nullptr;
  for (const Shown& one : shown) {
    if (left == 0) break;
    --left;
    if (metric == nullptr || *metric != one.comparison->metric) {
      html += fmt::format(
          "{}<tbody data-group=\"{}\"><tr class=\"group\"><th scope=\"rowgroup\" colspan=\"{}\">{}</th></tr>",
          metric == nullptr ? "" : "</tbody>", EscapeMarkup(WordsFor(one.comparison->metric).label), swept ? 10 : 9,
          EscapeMarkup(MetricHeading(one.comparison->metric)));
      metric = &one.comparison->metric;
    }
    html += RowHtml(scenario, one, swept);
  }
  return html + "</tbody></table></div>";
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

std::size_t CountComparisons(const ScenarioSummary& scenario) { return DistinctOf(scenario).size(); }

std::string ComparisonTableHtml(const ScenarioSummary& scenario) {
  const std::vector<Shown> all = DistinctOf(scenario);
  if (all.empty()) return "";
  const auto others = std::ranges::find_if(
      all, [&](const Shown& shown) { return shown.comparison->metric != all.front().comparison->metric; });
  const std::span<const Shown> lead(all.begin(), others), rest(others, all.end());
  std::size_t left = kMostTableRows;
  std::string html = TableHtml(scenario, lead, left);
  if (!rest.empty() && left > 0) {
    html += fmt::format("<details><summary>and {} more, by the other metrics</summary>{}</details>", rest.size(),
                        TableHtml(scenario, rest, left));
  }
  return html + LeftOutHtml(all.size(), kMostTableRows, "comparisons", kAllComparisons) +
         fmt::format("<p class=\"quiet legend\">{}</p>", EscapeMarkup(Legend(scenario)));
}

std::string ComparisonTableMarkdown(const ScenarioSummary& scenario) {
  const std::vector<Shown> all = DistinctOf(scenario);
  if (all.empty()) return "";
  std::string text = fmt::format(
      "\n<details><summary>Every comparison ({})</summary>\n\n"
      "| metric | methods | condition | difference (95 % interval) | on {} | for {} | worlds | p (Holm) | effect | "
      "mind "
      "|\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      all.size(), TheseUnits(scenario.unit), OtherUnits(scenario.unit));
  for (const Shown& shown : std::span(all).first(std::min(all.size(), kMostTableRows))) {
    const Comparison& c = *shown.comparison;
    const Line line = LineOf(*shown.condition, c, scenario.unit);
    text += fmt::format("| {} | {}{} | {} | {} ({}) | {} | {} | {} | {} | {} | {} |\n", EscapeMarkdown(line.metric),
                        EscapeMarkdown(line.methods), shown.against == Against::kRival ? " (strongest other)" : "",
                        EscapeMarkdown(line.condition), line.difference, line.interval, VerdictName(c.verdict),
                        line.beyond, line.pairs, EscapeMarkdown(line.p), line.effect, EscapeMarkdown(line.notes));
  }
  const std::string rest = LeftOutWords(all.size(), kMostTableRows, "comparisons", kAllComparisons);
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
    csv += fmt::format("{},{},{},{},{},", CsvText(scenario.name), CsvText(ConditionLabel(condition.condition)),
                       CsvText(c.metric), CsvText(c.baseline), CsvText(c.method));
    csv += fmt::format("{},{},{},{},{},", c.pairs, c.differing, c.only_baseline, c.only_method, c.neither);
    csv += fmt::format("{},{},{},{},{},{},{},", ExactText(c.difference), ExactText(c.ci_low), ExactText(c.ci_high),
                       IntervalKindName(c.interval), ExactText(c.mean), ExactText(c.mean_low), ExactText(c.mean_high));
    csv += fmt::format("{},{},{},{},{},", ExactText(c.signed_rank.p), CsvText(c.signed_rank.how),
                       ExactText(c.sign_flip.p), CsvText(c.sign_flip.how), ExactText(c.p_holm));
    csv += fmt::format("{},{},{},{},", ExactText(c.effect_size),
                       ExactText(c.pairs > 0 ? std::optional(c.share_better) : std::nullopt), VerdictName(c.verdict),
                       CsvText(Notes(c)));
    csv += fmt::format("{},{},", against == Against::kRival ? "rival" : "baseline", SamplingUnitName(scenario.unit));
    csv += BeyondCsv(c.beyond);
  });
  return csv;
}

std::string AcrossTableHtml(const ScenarioSummary& scenario) {
  if (scenario.across.empty()) return "";
  std::string html =
      "<p class=\"quiet legend\">What holds under all of them:</p><div class=\"scroll\" tabindex=\"0\" role=\"region\" "
      "aria-label=\"What holds under all\"><table class=\"data\"><thead><tr>";
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
