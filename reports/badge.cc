#include "reports/badge.h"

#include <fmt/core.h>

#include <array>

#include "io/drawing/escape.h"

namespace etude {
namespace {

std::string_view VerdictClass(const std::optional<Verdict>& verdict) {
  constexpr std::array<std::string_view, kVerdicts.size()> kClasses = {"better", "worse", "same", "open"};
  return verdict ? kClasses[static_cast<std::size_t>(*verdict)] : "mixed";
}

/// Returns true if the verdict on the worlds of this run is decided, but the verdict for other clips or people differs
/// or is missing.
bool HoldsHereOnly(const Comparison& c) { return c.verdict != Verdict::kUndecided && c.beyond.verdict != c.verdict; }

}  // namespace

std::string_view VerdictSign(const std::optional<Verdict>& verdict) {
  constexpr std::array<std::string_view, kVerdicts.size()> kSigns = {"▲", "▼", "=", "?"};
  return verdict ? kSigns[static_cast<std::size_t>(*verdict)] : "±";
}

std::string ComparisonSign(const Comparison& comparison) {
  const std::string_view sign = VerdictSign(comparison.verdict);
  return HoldsHereOnly(comparison) ? fmt::format("({})", sign) : std::string(sign);
}

std::string ComparisonMark(const Comparison& comparison, SamplingUnit unit) {
  const std::string where = HoldsHereOnly(comparison) ? fmt::format(", on {} only", TheseUnits(unit)) : "";
  return fmt::format("<b class=\"{}\" role=\"img\" aria-label=\"{}{}\">{}</b>", VerdictClass(comparison.verdict),
                     VerdictName(comparison.verdict), where, ComparisonSign(comparison));
}

std::string FindingBadge(const MethodFinding& finding, std::string_view words) {
  if (!finding.is_compared) return "";
  const bool here_only = finding.verdict != Verdict::kUndecided && !finding.beyond.as_on_these;
  const std::string_view sign = VerdictSign(finding.verdict);
  return fmt::format("<span class=\"badge {}\" title=\"{}\"><span role=\"img\" aria-label=\"{}\">{}</span> {}</span>",
                     VerdictClass(finding.verdict), EscapeMarkup(finding.sentence), finding.Words(),
                     here_only ? fmt::format("({})", sign) : std::string(sign), EscapeMarkup(words));
}

std::string VerdictBadge(const std::optional<Verdict>& verdict) {
  return fmt::format("<span class=\"badge {}\">{}</span>", VerdictClass(verdict), VerdictWords(verdict));
}

std::string VerdictBadges(const MethodFinding& finding) {
  if (!finding.is_compared) return "";
  const std::string_view others = OtherUnits(finding.unit);
  const auto badge = [](const std::optional<Verdict>& verdict, const std::string& words) {
    return fmt::format("<span class=\"badge {}\"><span aria-hidden=\"true\">{}</span> {}</span>", VerdictClass(verdict),
                       VerdictSign(verdict), words);
  };
  if (WorldsAreUnits(finding.unit) && finding.beyond.as_on_these) {
    return badge(finding.verdict, fmt::format("{} and others", finding.Words()));
  }
  std::string here = badge(finding.verdict, finding.Words());
  if (finding.beyond.on_these_only) {
    return here + fmt::format(" <span class=\"badge none\">no verdict for {}</span>", others);
  }
  return here + " " +
         badge(finding.beyond.verdict, fmt::format("{} for {}", VerdictWords(finding.beyond.verdict), others));
}

}  // namespace etude
