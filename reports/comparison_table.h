#pragma once

#include <string>

#include "bench/results/run_data.h"

namespace etude {

/// Every comparison of one scenario, a row each: pairs, difference with its interval, corrected p, effect size,
/// verdict, and what to know before believing it. "" when nothing is compared.
std::string ComparisonTableHtml(const ScenarioSummary& scenario);

/// The same as a Markdown table that is folded away until it is asked for.
std::string ComparisonTableMarkdown(const ScenarioSummary& scenario);

/// The same as CSV: full precision, both tests, empty fields for values that do not exist.
std::string ComparisonTableCsv(const ScenarioSummary& scenario);

}  // namespace etude
