#include "bench/gate/snapshot.h"

#include <map>
#include <utility>

#include "bench/metrics/catalogue.h"

namespace etude {
namespace {

/// Where the rows of a scenario belong.
class ScenarioTaker {
 public:
  explicit ScenarioTaker(const FinishedScenario& one) {
    const Study& study = one.study;
    taken_ = {study.scenario, one.seed, study.trials, one.worlds, one.methods, {}, {}};
    const auto trials = static_cast<std::size_t>(study.trials);
    for (const std::string& id : study.gate.metrics) taken_.metrics.emplace_back(id, FindMetric(id)->version);
    for (const std::vector<SweptValue>& condition : study.conditions) {
      for (const ComparedMethod& method : study.methods) {
        places_[{CompactLabel(condition), method.name}] = taken_.cells.size();
        SnapshotCells& cells = taken_.cells.emplace_back(
            SnapshotCells{CompactLabel(condition), method.name, std::string(trials, 'f'), {}});
        for (const std::string& id : study.gate.metrics) {
          cells.metrics.push_back({id, std::vector<std::optional<double>>(trials)});
        }
      }
    }
  }

  void Take(const Row& row) {
    if (row.condition != condition_ || label_.empty()) {  // rows of one condition come together
      condition_ = row.condition;
      label_ = CompactLabel(row.condition);
    }
    SnapshotCells& cells = taken_.cells[places_.at({label_, row.method})];
    const auto trial = static_cast<std::size_t>(row.trial);
    cells.statuses[trial] = StatusLetter(row.result.status);
    for (SnapshotValues& kept : cells.metrics) kept.values[trial] = ValueOf(row, kept.metric);
  }

  SnapshotScenario Finish() { return std::move(taken_); }

 private:
  SnapshotScenario taken_;
  std::map<std::pair<std::string, std::string>, std::size_t> places_;  ///< in `cells`, by condition and method
  std::vector<SweptValue> condition_;
  std::string label_;
};

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
