#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/model/run_data.h"
#include "reports/words/findings.h"

namespace etude {

/// Returns a verdict as an HTML label: its word on a coloured background, so that no meaning depends on colour alone.
/// nullopt means that the verdict depends on the condition.
std::string VerdictBadge(const std::optional<Verdict>& verdict);

/// Returns both verdicts of a finding as HTML labels: the verdict on these worlds and the verdict for others like them.
/// If every world is its own unit and the verdicts agree, one label stands for both.
std::string VerdictBadges(const MethodFinding& finding);

/// Returns the sign of a verdict: "▲" better, "▼" worse, "=" equivalent, "?" inconclusive; "±" if the verdict depends
/// on the condition.
std::string_view VerdictSign(const std::optional<Verdict>& verdict);

/// Returns the sign of a comparison's verdict: "▲". The sign is in brackets if the verdict holds on these worlds only:
/// "(▲)".
std::string ComparisonSign(const Comparison& comparison);
/// Returns the sign of a comparison as HTML in the label's colour, with words for screen readers.
std::string ComparisonMark(const Comparison& comparison, SamplingUnit unit);
/// Returns the sign of a finding over all its conditions as an HTML label, followed by `words`; "" if nothing was
/// compared.
std::string FindingBadge(const MethodFinding& finding, std::string_view words);

}  // namespace etude
