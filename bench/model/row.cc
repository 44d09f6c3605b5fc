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

std::string_view StatusName(Status status) { return NameOfValue(kStatuses, status); }

bool DependsOnMachine(Status status) {
  return status == Status::kTimeout || status == Status::kCrashed || status == Status::kOutOfMemory;
}

std::optional<Status> FindStatus(std::string_view name) { return FindValue(kStatuses, name); }

std::string CompactLabel(const std::vector<SweptValue>& condition) {
  return condition.empty() ? "-" : LabelOf(condition, ",");
}

std::string ConditionLabel(const std::vector<SweptValue>& condition) { return LabelOf(condition, ", "); }

std::string Row::Id() const { return fmt::format("{}/{}/{:03}/{}", scenario, CompactLabel(condition), trial, method); }

double JudgedOn::ShareOf(std::string_view metric) const {
  for (const auto& [id, share] : shares) {
    if (id == metric) return share;
  }
  return 1;
}

std::optional<double> ValueOf(const Row& row, std::string_view metric) {
  for (const MetricValue& value : row.result.metrics) {
    if (value.id == metric) return value.value;
  }
  return std::nullopt;
}

}  // namespace etude
