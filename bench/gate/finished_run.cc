#include "bench/gate/finished_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "bench/metrics/catalogue.h"

namespace etude {
namespace {

constexpr std::string_view kStatusLetters = "ouftcmbs";  // one letter per status, in the order of Status

/// Checks the rows of a run that does not fit into memory. The run must have all its rows, in canonical order
/// (CellsOf).
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
      wrong = Error{place, "contains the cell " + row.Id() + " where the manifest has a different cell"};
    }
    ++next;
  });
  if (wrong) return tl::unexpected(*wrong);
  if (next == wanted.size() && scenario == run.scenarios.size()) return {};
  return Fail(place, "contains {} rows, but the manifest requires more rows", CountRows(run.data));
}

class ScenarioTaker {
 public:
  explicit ScenarioTaker(const FinishedScenario& one) {
    const Study& study = one.study;
    taken_ = {study.scenario, one.seed, study.trials, one.worlds, one.methods, {}, {}, one.files};
    const auto trials = static_cast<std::size_t>(study.trials);
    for (const std::string& id : study.gate.metrics) taken_.metrics.emplace_back(id, FindMetric(id)->version);
    for (const std::vector<SweptValue>& condition : study.conditions) {
      for (const ComparedMethod& method : study.methods) {
        slots_[{CompactLabel(condition), method.name}] = taken_.cells.size();
        SnapshotCells& cells = taken_.cells.emplace_back(
            SnapshotCells{CompactLabel(condition), method.name, std::string(trials, 'f'), {}});
        for (const std::string& id : study.gate.metrics) {
          cells.metrics.push_back({id, std::vector<std::optional<double>>(trials)});
        }
      }
    }
  }

  void Take(const Row& row) {
    // The label is computed once per condition, because the rows of a condition are consecutive.
    if (row.condition != condition_ || label_.empty()) {
      condition_ = row.condition;
      label_ = CompactLabel(row.condition);
    }
    SnapshotCells& cells = taken_.cells[slots_.at({label_, row.method})];
    const auto trial = static_cast<std::size_t>(row.trial);
    cells.statuses[trial] = StatusLetter(row.result.status);
    for (SnapshotValues& kept : cells.metrics) kept.values[trial] = ValueOf(row, kept.metric);
    if (row.result.judged.parts.empty()) return;
    cells.judged.resize(cells.statuses.size());
    cells.judged[trial] = row.result.judged;
    std::erase_if(cells.judged[trial].shares, [&](const auto& share) {
      return std::ranges::find(cells.metrics, share.first, &SnapshotValues::metric) == cells.metrics.end();
    });
  }

  SnapshotScenario Finish() { return std::move(taken_); }

 private:
  SnapshotScenario taken_;
  std::map<std::pair<std::string, std::string>, std::size_t> slots_;  ///< index in `cells`, by condition and method
  std::vector<SweptValue> condition_;
  std::string label_;
};

}  // namespace

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

Result<void> CheckRows(FinishedRun& run, const Place& place) {
  constexpr std::size_t kMaxNames = 100'000;  // maximum number of cell names that are held in memory
  if (CountRows(run.data) > kMaxNames) return CheckRowsInOrder(run, place);
  std::set<std::string> rows;
  std::string twice;
  ForEachRow(run.data, [&](const Row& row, std::size_t) {
    if (!rows.insert(row.Id()).second && twice.empty()) twice = row.Id();
  });
  if (!twice.empty()) return Fail(place, "contains the cell {} twice", twice);
  for (const FinishedScenario& one : run.scenarios) {
    const std::vector<std::string> wanted = CellsOf(one.study);
    std::vector<std::string> missing;
    for (const std::string& id : wanted) {
      if (rows.erase(id) == 0) missing.push_back(id);
    }
    if (missing.empty()) continue;
    run.incomplete.push_back(fmt::format("{}: {} of {} rows are missing; the first missing row is {}",
                                         one.study.scenario, missing.size(), wanted.size(), missing.front()));
  }
  if (!rows.empty())
    return Fail(place, "contains the cell {}, but no scenario of the manifest has this cell", *rows.begin());
  return {};
}

char StatusLetter(Status status) { return kStatusLetters[static_cast<std::size_t>(status)]; }

Status StatusOf(char letter) {
  const std::size_t index = kStatusLetters.find(letter);
  return index < kStatusLetters.size() ? static_cast<Status>(index) : Status::kFailed;
}

Snapshot TakeSnapshot(const FinishedRun& run) {
  std::map<std::string, ScenarioTaker> takers;
  for (const FinishedScenario& one : run.scenarios) takers.emplace(one.study.scenario, one);
  ForEachRow(run.data, [&](const Row& row, std::size_t) { takers.at(row.scenario).Take(row); });
  Snapshot snapshot{run.data.suite, run.data.program_version, {}};
  for (const FinishedScenario& one : run.scenarios) {
    snapshot.scenarios.push_back(takers.at(one.study.scenario).Finish());
  }
  return snapshot;
}

}  // namespace etude
