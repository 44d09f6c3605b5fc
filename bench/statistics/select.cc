#include "bench/statistics/select.h"

#include <algorithm>
#include <map>

namespace etude {

std::vector<const Row*> RowsIn(std::span<const Row> rows, const std::vector<Setting>& condition) {
  std::vector<const Row*> selected;
  for (const Row& row : rows) {
    if (row.condition == condition) selected.push_back(&row);
  }
  return selected;
}

std::vector<double> ValuesOf(std::span<const Row* const> rows, const std::string& method, const std::string& metric,
                             int& missing) {
  std::vector<double> values;
  missing = 0;
  for (const Row* row : rows) {
    if (row->method != method) continue;
    if (const auto value = ValueOf(*row, metric)) {
      values.push_back(*value);
    } else {
      ++missing;
    }
  }
  return values;
}

std::vector<Pair> PairsOf(std::span<const Row* const> rows, const std::string& baseline, const std::string& method,
                          const std::string& metric) {
  std::map<int, double> baseline_values;
  for (const Row* row : rows) {
    if (row->method != baseline) continue;
    if (const auto value = ValueOf(*row, metric)) baseline_values[row->trial] = *value;
  }
  std::vector<Pair> pairs;
  for (const Row* row : rows) {
    if (row->method != method) continue;
    const auto partner = baseline_values.find(row->trial);
    const auto value = ValueOf(*row, metric);
    if (value && partner != baseline_values.end()) pairs.push_back({partner->second, *value});
  }
  return pairs;
}

std::string PurposeOf(const std::string& scenario, const std::vector<Setting>& condition, const std::string& metric,
                      const std::string& baseline, const std::string& method) {
  return fmt::format("{}/{}/{}/{}/{}", scenario, ConditionLabel(condition), metric, baseline, method);
}

}  // namespace etude
