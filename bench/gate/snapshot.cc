#include "bench/gate/snapshot.h"

#include <map>

#include "bench/metrics/catalogue.h"

namespace etude {
namespace {

SnapshotScenario TakeScenario(const FinishedScenario& one, const std::map<std::string, const Row*>& rows) {
  const Study& study = one.study;
  SnapshotScenario taken{study.scenario, one.seed, study.trials, one.worlds, one.methods, {}, {}};
  const std::vector<std::string>& metrics = study.gate.metrics;
  for (const std::string& id : metrics) taken.metrics.emplace_back(id, FindMetric(id)->version);
  for (const std::vector<SweptValue>& condition : study.conditions) {
    for (const ComparedMethod& method : study.methods) {
      SnapshotCells& cells = taken.cells.emplace_back(SnapshotCells{CompactLabel(condition), method.name, "", {}});
      for (const std::string& id : metrics) cells.metrics.push_back({id, {}});
      Row identity{study.scenario, study.task, condition, 0, "", {}, method.name, {}};
      for (; identity.trial < study.trials; ++identity.trial) {
        const Row& row = *rows.at(identity.Id());
        cells.statuses += StatusLetter(row.result.status);
        for (SnapshotValues& kept : cells.metrics) kept.values.push_back(ValueOf(row, kept.metric));
      }
    }
  }
  return taken;
}

}  // namespace

char StatusLetter(Status status) {
  switch (status) {
    case Status::kOk:
      return 'o';
    case Status::kUnsolved:
      return 'u';
    case Status::kFailed:
      return 'f';
    case Status::kTimeout:
      return 't';
    case Status::kCrashed:
      return 'c';
    case Status::kOutOfMemory:
      return 'm';
    case Status::kBadOutput:
      return 'b';
    case Status::kSkipped:
      return 's';
  }
  return 'f';
}

Status StatusOf(char letter) {
  for (const Status status : {Status::kOk, Status::kUnsolved, Status::kTimeout, Status::kCrashed, Status::kOutOfMemory,
                              Status::kBadOutput, Status::kSkipped}) {
    if (StatusLetter(status) == letter) return status;
  }
  return Status::kFailed;
}

bool DependsOnMachine(char letter) { return letter == 't' || letter == 'c' || letter == 'm'; }

Snapshot TakeSnapshot(const FinishedRun& run) {
  std::map<std::string, const Row*> rows;
  for (const Row& row : run.data.rows) rows.emplace(row.Id(), &row);
  Snapshot snapshot{run.data.suite, run.data.program_version, {}};
  for (const FinishedScenario& one : run.scenarios) snapshot.scenarios.push_back(TakeScenario(one, rows));
  return snapshot;
}

}  // namespace etude
