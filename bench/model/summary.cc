#include "bench/model/summary.h"

namespace etude {

std::string_view IntervalKindName(IntervalKind kind) {
  switch (kind) {
    case IntervalKind::kBca:
      return "bca";
    case IntervalKind::kPercentile:
      return "percentile";
    case IntervalKind::kWilson:
      return "wilson";
    case IntervalKind::kAdjustedWald:
      return "adjusted wald";
    case IntervalKind::kStudent:
      return "student";
    case IntervalKind::kOrderStatistics:
      return "order statistics";
    case IntervalKind::kNone:
      break;
  }
  return "none";
}

std::string_view VerdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::kBetter:
      return "better";
    case Verdict::kWorse:
      return "worse";
    case Verdict::kNoDifference:
      return "no difference";
    case Verdict::kInconclusive:
      break;
  }
  return "inconclusive";
}

std::string_view RulingName(Ruling ruling) {
  switch (ruling) {
    case Ruling::kMet:
      return "met";
    case Ruling::kUnmet:
      return "unmet";
    case Ruling::kUndecided:
      break;
  }
  return "undecided";
}

}  // namespace etude
