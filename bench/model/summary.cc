#include "bench/results/run_data.h"

namespace etude {
namespace {

std::string LabelOf(const std::vector<Setting>& condition, std::string_view separator) {
  std::string label;
  for (const Setting& setting : condition) {
    if (!label.empty()) label += separator;
    label += setting.key + "=" + setting.value;
  }
  return label;
}

}  // namespace

std::string CompactLabel(const std::vector<Setting>& condition) {
  return condition.empty() ? "-" : LabelOf(condition, ",");
}

std::string ConditionLabel(const std::vector<Setting>& condition) { return LabelOf(condition, ", "); }

std::string Row::Id() const { return fmt::format("{}/{}/{:03}/{}", scenario, CompactLabel(condition), trial, method); }

std::optional<double> ValueOf(const Row& row, std::string_view metric) {
  for (const MetricValue& value : row.result.metrics) {
    if (value.id == metric) return value.value;
  }
  return std::nullopt;
}

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

std::string_view OutcomeName(Outcome outcome) {
  switch (outcome) {
    case Outcome::kMet:
      return "met";
    case Outcome::kUnmet:
      return "unmet";
    case Outcome::kUndecided:
      break;
  }
  return "undecided";
}

}  // namespace etude
