#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "bench/model/summary.h"
#include "reports/words/figures.h"

namespace etude {

/// Returns the heading of a group of rows: "orientation error (lower is better, 0.1° matters)".
std::string MetricHeading(const std::string& metric);

/// Explains the columns of the tables below.
inline constexpr std::string_view kComparisonLegend =
    "A difference is method − baseline in the same world. The table shows the median difference over worlds, or the "
    "mean difference for shares and penalised costs. Its 95 % interval is a BCa bootstrap interval, or an adjusted "
    "Wald interval for shares; † marks a percentile interval, where BCa is undefined. p is the p-value of Wilcoxon’s "
    "signed-rank test, or of a sign-flip test if the mean is shown, with Holm’s correction over the scenario’s "
    "comparisons. Effect is the rank-biserial correlation, from −1 to +1; positive values are better. The verdicts "
    "“better” and “worse” need p ≤ 0.05, an interval on one side of zero, and a difference that matters. The verdict "
    "“no difference” needs an interval that contains only differences that do not matter. If only one method failed in "
    "a world, p counts the world as a loss of this method, and the verdict must be the same with and without such "
    "worlds. The verdict about other clips, people or libraries uses the pseudo-median (Hodges–Lehmann estimate) of "
    "the mean differences of each clip, person or library. With fewer than 6 clips, people or libraries, there is no "
    "such verdict.";

/// Counts the comparisons in the tables below: each pair of methods under one metric and condition counts once.
std::size_t CountComparisons(const ScenarioSummary& scenario);

/// Returns every comparison of one scenario once as an HTML table, one row per comparison: the difference with its
/// interval, the verdict on the worlds of this run and the generalised verdict, the number of worlds, corrected p,
/// effect size and caveats. Comparisons by metrics other than the first are collapsed (<details>). Returns "" if no
/// methods are compared.
std::string ComparisonTableHtml(const ScenarioSummary& scenario);

/// Returns the comparisons of ComparisonTableHtml as a collapsed Markdown table (<details>).
std::string ComparisonTableMarkdown(const ScenarioSummary& scenario);

/// Returns all comparisons as CSV with full precision, with the test on worlds and the test on sampling units. Fields
/// of missing values are empty.
std::string ComparisonTableCsv(const ScenarioSummary& scenario);

/// Returns a table of the verdicts that must hold under every value of some parameters (scenario key `across`). Each
/// comparison has one row: the verdict if all values agree, else the values under which the verdict differs. Returns ""
/// if the scenario has no such key.
std::string AcrossTableHtml(const ScenarioSummary& scenario);

/// Returns the verdicts of AcrossTableHtml as a Markdown table.
std::string AcrossTableMarkdown(const ScenarioSummary& scenario);

}  // namespace etude
