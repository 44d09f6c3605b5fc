#include "reports/badge.h"

#include <fmt/core.h>

#include "reports/words/findings.h"

namespace etude {
namespace {

std::string_view VerdictClass(const std::optional<Verdict>& verdict) {
  if (!verdict) return "mixed";
  switch (*verdict) {
    case Verdict::kBetter:
      return "better";
    case Verdict::kWorse:
      return "worse";
    case Verdict::kNoDifference:
      return "same";
    case Verdict::kInconclusive:
      break;
  }
  return "open";
}

}  // namespace

std::string_view VerdictSign(const std::optional<Verdict>& verdict) {
  if (!verdict) return "±";
  switch (*verdict) {
    case Verdict::kBetter:
      return "▲";
    case Verdict::kWorse:
      return "▼";
    case Verdict::kNoDifference:
      return "=";
    case Verdict::kInconclusive:
      break;
  }
  return "?";
}

std::string VerdictMark(Verdict verdict) {
  return fmt::format("<b class=\"{}\" role=\"img\" aria-label=\"{}\">{}</b>", VerdictClass(verdict),
                     VerdictName(verdict), VerdictSign(verdict));
}

std::string VerdictBadge(const std::optional<Verdict>& verdict) {
  return fmt::format("<span class=\"badge {}\"><span aria-hidden=\"true\">{}</span> {}</span>", VerdictClass(verdict),
                     VerdictSign(verdict), VerdictWords(verdict));
}

}  // namespace etude
