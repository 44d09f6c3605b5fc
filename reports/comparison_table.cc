#include "reports/comparison_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "io/drawing/escape.h"
#include "io/drawing/table.h"
#include "reports/badge.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

// With these words, the page refers to the file that has the omitted comparisons.
constexpr std::string_view kAllComparisons = "the CSV file of comparisons in report/tables";

/// The texts of one comparison's table cells, not yet escaped.
struct Line {
  std::string condition, metric, methods, pairs, difference, interval, p, effect, beyond, notes;
};

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
  // If every world is its own sampling unit, `Notes` has already written why the verdict is undecided.
  if (c.beyond.why_open.empty() || WorldsAreUnits(unit)) return text;
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

/// Returns a verdict as a label, or kNoValue if there is no verdict. Below it stands `why`, unless `why` is empty: why
/// there is no verdict, why the verdict is undecided, or how the tail decided it.
std::string BadgeWithReason(const std::optional<Verdict>& verdict, const std::string& why) {
  return (verdict ? VerdictBadge(verdict) : std::string(kNoValue)) +
         (why.empty() ? "" : fmt::format("<small>{}</small>", EscapeMarkup(why)));
}

TableRow RowOf(const ScenarioSummary& scenario, const Shown& shown, bool swept) {
  const Comparison c = AsAnswered(*shown.condition, *shown.comparison);
  const Line line = LineOf(*shown.condition, c, scenario.unit);
  const std::string place = fmt::format("{}/{}/000/", scenario.name, CompactLabel(shown.condition->condition));
  std::string cells = place + c.method;  // IDs of the cells of all compared methods in trial 0, one per line
  for (const std::string& baseline : BaselinesOf({&c, shown.condition})) cells += "\n" + place + baseline;
  const std::string why_beyond = WorldsAreUnits(scenario.unit) ? "" : c.beyond.why_open;
  TableRow row{.cells = {line.methods}, .attributes = fmt::format(" data-ids=\"{}\"", EscapeMarkup(cells))};
  if (swept) row.cells.emplace_back(line.condition);
  row.cells.insert(row.cells.end(), {{line.difference, c.difference},
                                     {line.interval, c.ci_low},
                                     {"", {}, BadgeWithReason(c.verdict, c.why_open)},
                                     {"", {}, BadgeWithReason(c.beyond.verdict, why_beyond)},
                                     {line.pairs, c.pairs},
                                     {line.p, c.p_holm},
                                     {line.effect, c.effect_size},
                                     fmt::format("{}", fmt::join(c.notes, "; "))});
  return row;
}

std::string Legend(const ScenarioSummary& scenario) {
  std::size_t rivals = 0;
  for (const ConditionSummary& condition : scenario.conditions) rivals += condition.rivals.size();
  const std::string with_baselines = Plural(scenario.family, "comparison") + " with baselines";
  if (rivals == 0) return fmt::format("p-values have Holm’s correction over the {}.", with_baselines);
  return fmt::format(
      "p-values have Holm’s correction over the {}, and separately over the {} comparisons with the strongest other "
      "method. A pair of methods that is in both groups is listed only once.",
      with_baselines, FormatCount(static_cast<long long>(rivals)));
}

/// Calls `visit` for every comparison of every condition: first for the comparisons with baselines, then for the
/// comparisons with the strongest other method.
template <typename Visit>
void ForEachComparison(const ScenarioSummary& scenario, Visit visit) {
  for (const ConditionSummary& condition : scenario.conditions) {
    for (const Comparison& c : condition.comparisons) visit(condition, c, Against::kBaseline);
    for (const Comparison& c : condition.rivals) visit(condition, c, Against::kRival);
  }
}

/// Returns every comparison once, ordered by metric, then by kind (with the baseline, with the strongest other method),
/// then by method and condition. If a comparison with the strongest other method has the same two methods as a
/// comparison with a baseline, in either order, only the comparison with the baseline is returned.
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

/// Returns comparisons as an HTML table, grouped by metric. Writes at most `left` rows, and reduces `left` by the
/// number of written rows.
std::string ShownHtml(const ScenarioSummary& scenario, std::span<const Shown> shown, std::size_t& left) {
  const bool swept = scenario.conditions.size() > 1;
  // Add the columns. There is a condition column only if a parameter is swept.
  Table table{.label = "Comparisons", .style = "data", .columns = {{"Methods"}}};
  if (swept) table.columns.push_back({"Condition"});
  const auto number = [](const char* head, bool is_detail) {
    return TableColumn{.head = head, .is_number = true, .is_detail = is_detail, .is_sortable = true};
  };
  table.columns.insert(table.columns.end(), {number("Difference", false),
                                             number("95 % interval", false),
                                             {fmt::format("Verdict on {}", TheseUnits(scenario.unit))},
                                             {fmt::format("Verdict for {}", OtherUnits(scenario.unit))},
                                             number("Worlds", true),
                                             number("p (Holm)", true),
                                             number("Effect", true),
                                             {.head = "Notes", .is_detail = true}});
  // Add one row per comparison, below one heading row per metric.
  const std::string* metric = nullptr;
  for (const Shown& one : shown) {
    if (left == 0) break;
    --left;
    if (metric == nullptr || *metric != one.comparison->metric) {
      metric = &one.comparison->metric;
      table.rows.push_back({.group = MetricHeading(*metric),
                            .attributes = fmt::format(" data-group=\"{}\"", EscapeMarkup(WordsFor(*metric).label))});
    }
    table.rows.push_back(RowOf(scenario, one, swept));
  }
  return TableHtml(table);
}

/// Returns "holds" if all conditions have the same verdict. Otherwise returns how the verdicts differ: for example
/// "better under some values, worse under others".
std::string WhatHolds(const AcrossVerdict& across) {
  if (across.Holds()) return "holds";
  std::vector<Verdict> said;
  for (const AcrossVerdict::Each& each : across.each) {
    if (std::ranges::find(said, each.verdict) == said.end()) said.push_back(each.verdict);
  }
  if (said.size() == 1) return "undecided under all values";
  const auto says = [&](Verdict verdict) { return std::ranges::find(said, verdict) != said.end(); };
  return says(Verdict::kBetter) && says(Verdict::kWorse) ? "better under some values, worse under others"
                                                         : "does not hold under all values";
}

std::string MethodsOf(const AcrossVerdict& across) { return across.method + " − " + across.baseline; }

/// Returns the difference and the verdict under one condition: "3.10 pp better".
std::string EachText(const AcrossVerdict& across, const AcrossVerdict::Each& each) {
  if (!each.difference) return std::string(VerdictName(each.verdict));
  const MetricWords words = WordsFor(across.metric);
  return fmt::format("{} {}", ShortDifference(*each.difference, words), VerdictName(each.verdict));
}

Table AcrossTable(const ScenarioSummary& scenario) {
  Table table{
      .label = "Verdicts under all assumptions", .style = "data", .columns = {{"metric"}, {"methods"}, {"condition"}}};
  for (const AcrossVerdict::Each& each : scenario.across.front().each) table.columns.push_back({each.value});
  table.columns.push_back({"under all values"});
  for (const AcrossVerdict& across : scenario.across) {
    std::vector<TableCell> cells = {across.metric, MethodsOf(across), ConditionLabel(across.condition)};
    for (const AcrossVerdict::Each& each : across.each) cells.emplace_back(EachText(across, each));
    const std::string holds = WhatHolds(across);
    cells.push_back({fmt::format("{}: {}", VerdictName(across.verdict), holds),
                     {},
                     fmt::format("{} {}", VerdictBadge(across.verdict), holds)});
    table.rows.push_back({std::move(cells)});
  }
  return table;
}

}  // namespace

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
  std::size_t left = kMaxTableRows;
  std::string html = ShownHtml(scenario, lead, left);
  if (!rest.empty() && left > 0) {
    html += fmt::format("<details><summary>{} more comparisons, by the other metrics</summary>{}</details>",
                        rest.size(), ShownHtml(scenario, rest, left));
  }
  return html + LeftOutHtml(all.size(), kMaxTableRows, "comparisons", kAllComparisons) +
         fmt::format("<p class=\"quiet legend\">{}</p>", EscapeMarkup(Legend(scenario)));
}

std::string ComparisonTableMarkdown(const ScenarioSummary& scenario) {
  const std::vector<Shown> all = DistinctOf(scenario);
  if (all.empty()) return "";
  Table table{.columns = {{"metric"},
                          {"methods"},
                          {"condition"},
                          {"difference (95 % interval)"},
                          {fmt::format("verdict on {}", TheseUnits(scenario.unit))},
                          {fmt::format("verdict for {}", OtherUnits(scenario.unit))},
                          {"worlds"},
                          {"p (Holm)"},
                          {"effect"},
                          {"notes"}}};
  for (const Shown& shown : std::span(all).first(std::min(all.size(), kMaxTableRows))) {
    const Comparison c = AsAnswered(*shown.condition, *shown.comparison);
    const Line line = LineOf(*shown.condition, c, scenario.unit);
    table.rows.push_back({{line.metric, line.methods + (shown.against == Against::kRival ? " (strongest other)" : ""),
                           line.condition, fmt::format("{} ({})", line.difference, line.interval),
                           VerdictName(c.verdict), line.beyond, line.pairs, line.p, line.effect, line.notes}});
  }
  const std::string rest = LeftOutWords(all.size(), kMaxTableRows, "comparisons", kAllComparisons);
  return fmt::format("\n<details><summary>All comparisons ({})</summary>\n{}{}\n{}\n\n</details>\n", all.size(),
                     TableMarkdown(table), rest.empty() ? "" : fmt::format("\n{}\n", EscapeMarkdown(rest)),
                     EscapeMarkdown(Legend(scenario)));
}

std::string ComparisonTableCsv(const ScenarioSummary& scenario) {
  // Write the headings: first the headings for the comparison on the worlds of this run, then the headings for the
  // comparison generalised to other sampling units (clips, people, …).
  Table table;
  for (const char* head : {"scenario",        "condition",        "metric",        "baseline",        "method",
                           "pairs",           "differing",        "only_baseline", "only_method",     "neither",
                           "difference",      "ci95_low",         "ci95_high",     "interval",        "mean_difference",
                           "mean_ci95_low",   "mean_ci95_high",   "p_signed_rank", "signed_rank_how", "p_sign_flip",
                           "sign_flip_how",   "p_holm",           "effect_size",   "share_better",    "verdict",
                           "notes",           "against",          "unit",          "units",           "beyond_mean",
                           "beyond_ci95_low", "beyond_ci95_high", "beyond_p",      "beyond_how",      "beyond_p_holm",
                           "beyond_verdict",  "beyond_why_open"}) {
    table.columns.push_back({head});
  }
  // Write the values in the order of the headings.
  ForEachComparison(scenario, [&](const ConditionSummary& condition, const Comparison& c, Against against) {
    const Beyond& beyond = c.beyond;
    table.rows.push_back({{scenario.name,
                           ConditionLabel(condition.condition),
                           c.metric,
                           c.baseline,
                           c.method,
                           c.pairs,
                           c.differing,
                           c.only_baseline,
                           c.only_method,
                           c.neither,
                           c.difference,
                           c.ci_low,
                           c.ci_high,
                           IntervalKindName(c.interval),
                           c.mean,
                           c.mean_low,
                           c.mean_high,
                           c.signed_rank.p,
                           c.signed_rank.how,
                           c.sign_flip.p,
                           c.sign_flip.how,
                           c.p_holm,
                           c.effect_size,
                           c.pairs > 0 ? std::optional(c.share_better) : std::nullopt,
                           VerdictName(c.verdict),
                           Notes(c),
                           against == Against::kRival ? "rival" : "baseline",
                           SamplingUnitName(scenario.unit),
                           beyond.units,
                           beyond.difference,
                           beyond.low,
                           beyond.high,
                           beyond.test.p,
                           beyond.test.how,
                           beyond.p_holm,
                           beyond.verdict ? VerdictName(*beyond.verdict) : "",
                           beyond.why_open}});
  });
  return TableCsv(table);
}

std::string AcrossTableHtml(const ScenarioSummary& scenario) {
  if (scenario.across.empty()) return "";
  return "<p class=\"quiet legend\">Verdicts under each value of the parameters in the scenario key "
         "<code>across</code>. A verdict holds only if it is the same under all values:</p>" +
         TableHtml(AcrossTable(scenario));
}

std::string AcrossTableMarkdown(const ScenarioSummary& scenario) {
  if (scenario.across.empty()) return "";
  return "\n"
         "Verdicts under each value of the parameters in the scenario key `across`. A verdict holds only if it is the "
         "same under all values:\n" +
         TableMarkdown(AcrossTable(scenario));
}

}  // namespace etude
