#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/model/run_data.h"
#include "reports/words/findings.h"

namespace etude {

/// Returns a verdict as an HTML label: the verdict's name on a coloured background, so that no meaning depends on
/// colour alone. nullopt stands for conditions with different verdicts.
std::string VerdictBadge(const std::optional<Verdict>& verdict);

/// Returns a finding's two verdicts as HTML labels: the verdict on the worlds of this run, and the verdict generalised
/// to other clips, people or libraries. If every world is its own sampling unit and the verdicts agree, returns one
/// label for the two verdicts.
std::string VerdictBadges(const MethodFinding& finding);

/// Returns the symbol of a verdict: "▲" better, "▼" worse, "=" equivalent, "?" undecided, "±" if the verdict depends
/// on the condition.
std::string_view VerdictSign(const std::optional<Verdict>& verdict);

/// Returns the symbol of a comparison's verdict, such as "▲". The symbol is in brackets, "(▲)", if the verdict on the
/// worlds of this run does not generalise to other clips or people.
std::string ComparisonSign(const Comparison& comparison);
/// Returns the symbol of a comparison (ComparisonSign) as HTML in the verdict's colour, with the verdict's name for
/// screen readers.
std::string ComparisonMark(const Comparison& comparison, SamplingUnit unit);
/// Returns the symbol of a finding over all its conditions as an HTML label, followed by `words`. Returns "" if the
/// method was not compared.
std::string FindingBadge(const MethodFinding& finding, std::string_view words);

}  // namespace etude
