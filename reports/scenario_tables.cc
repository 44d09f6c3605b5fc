#include <fmt/core.h>

#include <algorithm>

#include "io/drawing/escape.h"
#include "io/drawing/table.h"
#include "reports/comparison_table.h"
#include "reports/page.h"
#include "reports/paper/paper_a.h"
#include "reports/paper/paper_b_section.h"
#include "reports/words/answer.h"
#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

constexpr std::size_t kRowsPerFloat = 50;  // the number of rows that fit on a page of A4

constexpr std::string_view kHead =
    "% Needs \\usepackage{booktabs}. The CSV files in this folder contain the same numbers with all digits.\n";

using Group = std::vector<TableRow>;

std::string_view Stars(const Comparison& c) {
  if (!c.not_alike.empty() || !c.p_holm || *c.p_holm > 0.05) return "";
  return *c.p_holm <= 0.001 ? "$^{***}$" : *c.p_holm <= 0.01 ? "$^{**}$" : "$^{*}$";
}

std::string WithInterval(const std::string& value, const std::optional<double>& low, const std::optional<double>& high,
                         const MetricWords& words) {
  return low && high ? fmt::format("{} [{}]", value, FormatInterval(low, high, words)) : value;
}

std::string CountText(int present, int attempted) {
  return present == attempted ? FormatCount(present)
                              : fmt::format("{} of {}", FormatCount(present), FormatCount(attempted));
}

Group EndedOk(const ScenarioSummary& scenario, const ConditionSummary& condition) {
  const MetricWords share{.label = "", .suffix = " %", .difference_suffix = "", .scale = 100, .is_share = true};
  Group group = {{.group = "cells with status ok"}};
  for (const MethodSummary& method : condition.methods) {
    if (method.attempted == 0) continue;
    group.push_back({{MethodLabel(scenario, method.method), FormatCount(method.attempted),
                      WithInterval(FormatShare(method.ok, method.attempted), method.ok_low, method.ok_high, share), "",
                      "", "", "", ""}});
  }
  return group;
}

std::vector<TableCell> ComparisonCells(const ConditionSummary& condition, const Comparison& as_measured,
                                       const MetricWords& words) {
  const Comparison c = AsAnswered(condition, as_measured);
  const std::string difference = c.difference ? ShortDifference(*c.difference, words) : std::string(kNoValue);
  std::vector<TableCell> cells = {c.baseline, WithInterval(difference, c.ci_low, c.ci_high, words), FormatP(c.p_holm),
                                  VerdictName(c.verdict), c.beyond.verdict ? VerdictName(*c.beyond.verdict) : ""};
  cells[1].latex_sign = Stars(c);
  if (!c.beyond.verdict) cells.back().latex_sign = "--";
  return cells;
}

/// Returns a method's comparisons with baselines. Adds the method's comparisons with the strongest other method, unless
/// the same two methods are already compared.
std::vector<const Comparison*> ComparisonsOf(const ConditionSummary& condition, const std::string& method,
                                             const std::string& metric) {
  std::vector<const Comparison*> found;
  for (const auto* comparisons : {&condition.comparisons, &condition.rivals}) {
    for (const Comparison& c : *comparisons) {
      const bool is_there =
          std::ranges::any_of(found, [&](const Comparison* other) { return other->baseline == c.baseline; });
      if (c.metric == metric && c.method == method && !is_there) found.push_back(&c);
    }
  }
  return found;
}

Group OfMetric(const ScenarioSummary& scenario, const ConditionSummary& condition, const std::string& metric) {
  const MetricWords words = WordsFor(metric);
  Group group = {{.group = MetricHeading(metric)}};
  for (const MethodSummary& method : condition.methods) {
    const MetricSummary* summary = FindSummary(method, metric);
    if (summary == nullptr) continue;
    std::vector<TableCell> cells = {
        MethodLabel(scenario, method.method), CountText(summary->present, summary->present + summary->missing),
        WithInterval(FormatValue(TypicalValue(*summary, words), words), summary->ci_low, summary->ci_high, words)};
    const std::vector<const Comparison*> comparisons = ComparisonsOf(condition, method.method, metric);
    for (const Comparison* c : comparisons) {
      std::ranges::move(ComparisonCells(condition, *c, words), std::back_inserter(cells));
      group.push_back({std::move(cells)});
      cells = {"", "", ""};  // only the method's first row shows the method's own figures
    }
    if (!comparisons.empty()) continue;
    cells.resize(cells.size() + 5);
    group.push_back({std::move(cells)});
  }
  return group;
}

std::string Caption(const ScenarioSummary& scenario, const ConditionSummary& condition) {
  const std::string label = ConditionLabel(condition.condition);
  const std::string& title = scenario.question.empty() ? scenario.name : scenario.question;
  std::string answer;
  if (const std::string asked = MethodInQuestion(scenario); !asked.empty() && !scenario.headline_metrics.empty()) {
    const MethodFinding found = CompareInWords(scenario, asked, scenario.headline_metrics.front(), Against::kBaseline);
    if (found.is_compared) answer = fmt::format(" {} ({})", found.sentence, found.BothVerdicts()) + ".";
  }
  std::size_t rivals = 0;
  for (const ConditionSummary& one : scenario.conditions) rivals += one.rivals.size();
  return fmt::format(
      "{}{}{} Value: the median (for shares, the mean) with its 95 % interval. n: the number of cells with a value, "
      "out of all attempted cells. Difference: method − baseline in the same world; the median (for shares and "
      "penalised costs, the mean) with its 95 % interval. A second row compares the method with the strongest other "
      "method. The last columns contain the verdict on {} and the verdict for {} (--: no verdict, because there are "
      "fewer than 6 of them). p has Holm’s correction over this scenario’s {} with baselines{}: ",
      title, label.empty() ? "" : fmt::format(" ({})", label), answer, TheseUnits(scenario.unit),
      OtherUnits(scenario.unit), Plural(scenario.family, "comparison"),
      rivals == 0 ? "" : fmt::format(", and separately over the {} with the strongest other method", rivals));
}

constexpr std::string_view kStarsCaption =
    "$^{*}$~$p \\le 0.05$, $^{**}$~$p \\le 0.01$, $^{***}$~$p \\le 0.001$. “Better” and “worse” also need an interval "
    "on one side of zero and a difference that matters. “No difference” needs an interval that contains only "
    "differences that do not matter.";

std::string Float(const std::string& caption, const Table& table) {
  return fmt::format(
      "\n\\begin{{table}}[!htbp]\n\\centering\\scriptsize\\setlength{{\\tabcolsep}}{{3pt}}\n\\caption{{{}}}"
      "\n\\smallskip\n{}\\end{{table}}\n",
      caption, TableLatex(table));
}

/// Returns the LaTeX floats of one condition: as many floats as the condition's rows need.
std::string ConditionFloats(const ScenarioSummary& scenario, const ConditionSummary& condition) {
  std::vector<Group> groups{EndedOk(scenario, condition)};
  for (const std::string& metric : TableMetrics(scenario)) groups.push_back(OfMetric(scenario, condition, metric));

  std::string text;
  std::string caption = EscapeLatex(Caption(scenario, condition)) + std::string(kStarsCaption);
  Table table{.columns = {{"method"},
                          {.head = "n", .is_number = true},
                          {.head = "value", .is_number = true},
                          {"against"},
                          {.head = "difference", .is_number = true},
                          {.head = "p", .is_number = true, .latex = "$p$"},
                          {fmt::format("on {}", TheseUnits(scenario.unit))},
                          {fmt::format("for {}", OtherUnits(scenario.unit))}}};
  for (Group& group : groups) {
    if (!table.rows.empty() && table.rows.size() + group.size() > kRowsPerFloat) {
      text += Float(caption, table);
      caption = EscapeLatex(fmt::format("{} (continued)", scenario.name));
      table.rows.clear();
    }
    std::ranges::move(group, std::back_inserter(table.rows));
  }
  return text + Float(caption, table);
}

std::string MissingText(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition,
                        const MethodSummary& method, const MetricSummary& metric) {
  if (metric.missing == 0) return "";
  return MissingReasons(run, scenario.name, condition.condition, method.method, metric.id);
}

}  // namespace

std::string ScenarioLatex(const RunData& run, const ScenarioSummary& scenario) {
  std::string text = fmt::format("{}% Etude {}.\n", kHead, run.program_version);
  for (const ConditionSummary& condition : scenario.conditions) text += ConditionFloats(scenario, condition);
  return text + PaperALatex(scenario) + PaperBLatex(run, scenario);
}

std::string NumberTableCsv(const RunData& run, const ScenarioSummary& scenario) {
  Table table;
  for (const char* head : {"scenario", "condition", "method", "metric", "unit_label", "median", "ci95_low", "ci95_high",
                           "mean", "present", "missing", "missing_why", "interval"}) {
    table.columns.push_back({head});
  }
  for (const ConditionSummary& condition : scenario.conditions) {
    const std::string label = ConditionLabel(condition.condition);
    for (const MethodSummary& method : condition.methods) {
      if (method.attempted > 0) {
        table.rows.push_back({{scenario.name, label, method.method, "ok_share", "", "", method.ok_low, method.ok_high,
                               static_cast<double>(method.ok) / method.attempted, method.attempted, 0, "", "wilson"}});
      }
      for (const MetricSummary& metric : method.metrics) {
        const MetricInfo* info = FindMetric(metric.id);
        table.rows.push_back(
            {{scenario.name, label, method.method, metric.id, info == nullptr ? "" : info->unit, metric.median,
              metric.ci_low, metric.ci_high, metric.mean, metric.present, metric.missing,
              MissingText(run, scenario, condition, method, metric), IntervalKindName(metric.interval)}});
      }
    }
  }
  return TableCsv(table);
}

}  // namespace etude
