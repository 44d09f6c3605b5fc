#include "bench/statistics/select.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

namespace etude {

std::vector<const Row*> RowsIn(std::span<const Row> rows, const std::vector<SweptValue>& condition) {
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

PairedWorlds PairsOf(std::span<const Row* const> rows, const std::string& baseline, const std::string& method,
                     const std::string& metric) {
  struct World {
    const Row* baseline = nullptr;
    const Row* method = nullptr;
  };
  std::map<int, World> worlds;
  for (const Row* row : rows) {
    if (row->method == baseline) worlds[row->trial].baseline = row;
    if (row->method == method) worlds[row->trial].method = row;
  }
  const auto value_in = [&](const Row* row) { return row == nullptr ? std::nullopt : ValueOf(*row, metric); };
  const auto skipped = [](const Row* row) { return row == nullptr || row->result.status == Status::kSkipped; };
  const auto failed = [](const Row* row) {
    return row != nullptr && row->result.status != Status::kOk && row->result.status != Status::kSkipped;
  };
  PairedWorlds paired;
  for (const auto& [trial, world] : worlds) {
    const auto of_baseline = value_in(world.baseline), of_method = value_in(world.method);
    if (of_baseline && of_method) {
      paired.pairs.push_back({*of_baseline, *of_method});
    } else if (of_baseline) {
      ++paired.only_baseline;
      paired.failed.method += failed(world.method);
    } else if (of_method) {
      ++paired.only_method;
      paired.failed.baseline += failed(world.baseline);
    } else if (!skipped(world.baseline) || !skipped(world.method)) {
      ++paired.neither;
    }
  }
  return paired;
}

std::string PurposeOf(const std::string& scenario, const std::vector<SweptValue>& condition, const std::string& metric,
                      const std::string& baseline, const std::string& method) {
  return fmt::format("{}/{}/{}/{}/{}", scenario, ConditionLabel(condition), metric, baseline, method);
}

}  // namespace etude
