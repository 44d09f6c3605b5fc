#include "bench/model/row.h"

#include <fmt/core.h>

namespace etude {
namespace {

std::string LabelOf(const std::vector<SweptValue>& condition, std::string_view separator) {
  std::string label;
  for (const SweptValue& swept : condition) {
    if (!label.empty()) label += separator;
    label += swept.key + "=" + swept.value;
  }
  return label;
}

}  // namespace

std::string_view StatusName(Status status) {
  switch (status) {
    case Status::kOk:
      return "ok";
    case Status::kUnsolved:
      return "unsolved";
    case Status::kFailed:
      return "failed";
    case Status::kTimeout:
      return "timeout";
    case Status::kCrashed:
      return "crashed";
    case Status::kOutOfMemory:
      return "out_of_memory";
    case Status::kBadOutput:
      return "bad_output";
    case Status::kSkipped:
      return "skipped";
  }
  return "failed";
}

std::optional<Status> FindStatus(std::string_view name) {
  for (int i = 0; i < kStatusCount; ++i) {
    if (StatusName(static_cast<Status>(i)) == name) return static_cast<Status>(i);
  }
  return std::nullopt;
}

std::string CompactLabel(const std::vector<SweptValue>& condition) {
  return condition.empty() ? "-" : LabelOf(condition, ",");
}

std::string ConditionLabel(const std::vector<SweptValue>& condition) { return LabelOf(condition, ", "); }

std::string Row::Id() const { return fmt::format("{}/{}/{:03}/{}", scenario, CompactLabel(condition), trial, method); }

std::optional<double> ValueOf(const Row& row, std::string_view metric) {
  for (const MetricValue& value : row.result.metrics) {
    if (value.id == metric) return value.value;
  }
  return std::nullopt;
}

}  // namespace etude
