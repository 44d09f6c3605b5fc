#pragma once

#include <string>

#include "bench/model/summary.h"
#include "reports/words/figures.h"

namespace etude {

/// What a group of rows is about: "orientation error (lower is better, 0.1° matters)".
std::string MetricHeading(const std::string& metric);

/// A difference with its unit, short: tables have no room for "percentage points".
std::string ShortDifference(double difference, const MetricWords& words);

/// Every comparison of one scenario, a row each: pairs, difference with its interval, corrected p, effect size,
/// verdict, and what to know before believing it. "" when nothing is compared.
std::string ComparisonTableHtml(const ScenarioSummary& scenario);

/// The same as a Markdown table that is folded away until it is asked for.
std::string ComparisonTableMarkdown(const ScenarioSummary& scenario);

/// The same as CSV: full precision, both tests, empty fields for values that do not exist.
std::string ComparisonTableCsv(const ScenarioSummary& scenario);

/// What holds under every value of the parameters that verdicts must hold for (`across`), a row per comparison: the
/// common verdict, or what differs. "" where nothing was asked to.
std::string AcrossTableHtml(const ScenarioSummary& scenario);

/// The same as a Markdown table.
std::string AcrossTableMarkdown(const ScenarioSummary& scenario);

}  // namespace etude
