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

/// The rows of a run that are not held stand where their identities have them: none is there twice.
Result<void> CheckRowsInOrder(const FinishedRun& run, const Place& place) {
  std::vector<std::string> wanted;
  std::size_t scenario = 0, next = 0;
  std::optional<Error> wrong;
  ForEachRow(run.data, [&](const Row& row, std::size_t) {
    while (next == wanted.size() && scenario < run.scenarios.size()) {
      wanted = CellsOf(run.scenarios[scenario++].study);
      next = 0;
    }
    if (wrong) return;
    if (next == wanted.size() || wanted[next] != row.Id()) {
      wrong = Error{place, "holds the cell " + row.Id() + " where the manifest has another"};
    }
    ++next;
  });
  if (wrong) return tl::unexpected(*wrong);
  if (next == wanted.size() && scenario == run.scenarios.size()) return {};
  return Fail(place, "holds {} rows; the manifest makes more", CountRows(run.data));
}

}  // namespace

Result<void> CheckRows(FinishedRun& run, const Place& place) {
  if (run.data.source) return CheckRowsInOrder(run, place);
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
