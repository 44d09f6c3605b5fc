#include "bench/gate/finished_run.h"

#include <fmt/core.h>

#include <set>

namespace etude {
namespace {

/// The identities of all cells that a scenario asks for, in canonical order.
std::vector<std::string> CellsOf(const Study& study) {
  std::vector<std::string> ids;
  Row row;
  row.scenario = study.scenario;
  for (const std::vector<SweptValue>& condition : study.conditions) {
    row.condition = condition;
    for (row.trial = 0; row.trial < study.trials; ++row.trial) {
      for (const ComparedMethod& method : study.methods) {
        row.method = method.name;
        ids.push_back(row.Id());
      }
    }
  }
  return ids;
}

}  // namespace

Result<void> CheckRows(FinishedRun& run, const Place& place) {
  std::set<std::string> rows;
  for (const Row& row : run.data.rows) {
    if (!rows.insert(row.Id()).second) return Fail(place, "holds the cell {} twice", row.Id());
  }
  for (const FinishedScenario& one : run.scenarios) {
    const std::vector<std::string> wanted = CellsOf(one.study);
    std::vector<std::string> missing;
    for (const std::string& id : wanted) {
      if (rows.erase(id) == 0) missing.push_back(id);
    }
    if (missing.empty()) continue;
    run.incomplete.push_back(fmt::format("{}: {} of {} rows are missing, the first is {}", one.study.scenario,
                                         missing.size(), wanted.size(), missing.front()));
  }
  if (!rows.empty()) return Fail(place, "holds the cell {}, which no scenario of the manifest asks for", *rows.begin());
  return {};
}

}  // namespace etude
