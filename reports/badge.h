#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bench/model/run_data.h"
#include "reports/words/findings.h"

namespace etude {

/// Writes a verdict as a coloured label of HTML, its word, so that colour says nothing alone. Nothing stands for
/// "it depends" on the condition.
std::string VerdictBadge(const std::optional<Verdict>& verdict);

/// Writes both verdicts of a finding as such labels: on these worlds, and for others like them. Where every world is
/// its own unit and both agree, one label says so.
std::string VerdictBadges(const MethodFinding& finding);

/// Gives the sign alone: "▲", "▼", "=", "?"; "±" when it depends.
std::string_view VerdictSign(const std::optional<Verdict>& verdict);

/// Gives the sign of a comparison, in brackets where it holds on these worlds only: "(▲)".
std::string ComparisonSign(const Comparison& comparison);
/// Writes the sign of a comparison as HTML in the label's colour, with words for screen readers.
std::string ComparisonMark(const Comparison& comparison, SamplingUnit unit);
/// Writes the sign of a finding over all its conditions as a label with `words` behind it; "" when not compared.
std::string FindingBadge(const MethodFinding& finding, std::string_view words);

}  // namespace etude
