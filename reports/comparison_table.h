#pragma once

#include <string>

#include "bench/model/summary.h"
#include "reports/words/figures.h"

namespace etude {

/// Writes the heading of a group of rows: "orientation error (lower is better, 0.1° matters)".
std::string MetricHeading(const std::string& metric);

/// Writes a difference with its unit, short: tables have no room for "percentage points".
std::string ShortDifference(double difference, const MetricWords& words);

/// Writes every comparison of one scenario as a table, a row each: pairs, difference with its interval, corrected p,
/// effect size, verdict, and what to know before believing it. "" when nothing is compared.
std::string ComparisonTableHtml(const ScenarioSummary& scenario);

/// Writes the same as a Markdown table that is folded away.
std::string ComparisonTableMarkdown(const ScenarioSummary& scenario);

/// Writes the same as CSV: full precision, both tests, empty fields for values that do not exist.
std::string ComparisonTableCsv(const ScenarioSummary& scenario);

/// Writes the verdicts that must hold under every value of some parameters (`across`) as a table, a row per comparison:
/// the common verdict, or what differs. "" where nothing was asked to.
std::string AcrossTableHtml(const ScenarioSummary& scenario);

/// Writes the same as a Markdown table.
std::string AcrossTableMarkdown(const ScenarioSummary& scenario);

}  // namespace etude
