#include "bench/gate/snapshot.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "bench/metrics/catalogue.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

void AddNode(Digest& digest, const Node& node) {
  digest.Add(static_cast<std::int64_t>(node.kind)).Add(std::string_view(node.scalar)).Add(std::string_view("\0", 1));
  digest.Add(static_cast<std::int64_t>(node.items.size() + node.entries.size()));
  for (const Node& item : node.items) AddNode(digest, item);
  for (const Node::Entry& entry : node.entries) {
    digest.Add(std::string_view(entry.key)).Add(std::string_view("\0", 1));
    AddNode(digest, entry.value);
  }
}

bool IsCommonKey(const std::string& key) {
  const auto keys = CommonScenarioKeys();
  return std::any_of(keys.begin(), keys.end(), [&](const KeyInfo& known) { return known.key == key; });
}

/// Of all that shapes the worlds of a condition: its task, the task's own keys, the clips.
std::string WorldDigest(const FinishedScenario& one, const Condition& condition) {
  Digest digest;
  digest.Add(std::string_view(one.scenario.task));
  std::vector<const Node::Entry*> own;
  for (const Node::Entry& entry : condition.node.entries) {
    if (!IsCommonKey(entry.key)) own.push_back(&entry);
  }
  std::sort(own.begin(), own.end(), [](const auto* a, const auto* b) { return a->key < b->key; });  // keys are unique
  for (const Node::Entry* entry : own) {
    digest.Add(std::string_view(entry->key)).Add(std::string_view("\0", 1));
    AddNode(digest, entry->value);
  }
  for (const std::string& clip : one.clip_digests) digest.Add(std::string_view(clip));
  return digest.Hex();
}

std::string MethodDigest(const MethodEntry& method) {
  Digest digest;
  AddNode(digest, method.node);
  for (const std::string& argument : method.exec) digest.Add(std::string_view(argument)).Add(std::string_view("\0", 1));
  digest.Add(std::string_view(method.options_json));
  return digest.Hex();
}

SnapshotScenario TakeScenario(const FinishedScenario& one, const std::map<std::string, const Row*>& rows) {
  const Scenario& scenario = one.scenario;
  SnapshotScenario taken{scenario.name, one.setup.seed, scenario.trials, {}, {}, {}, {}};
  const std::vector<std::string>& metrics = scenario.gate.metrics;
  for (const std::string& id : metrics) taken.metrics.emplace_back(id, FindMetric(id)->version);
  for (const MethodEntry& method : scenario.methods) taken.methods.emplace_back(method.name, MethodDigest(method));
  for (const Condition& condition : scenario.conditions) {
    const std::string label = CompactLabel(condition.settings);
    taken.worlds.emplace_back(label, WorldDigest(one, condition));
    for (const MethodEntry& method : scenario.methods) {
      SnapshotCells& cells = taken.cells.emplace_back(SnapshotCells{label, method.name, "", {}});
      for (const std::string& id : metrics) cells.metrics.push_back({id, {}});
      Row identity{scenario.name, scenario.task, condition.settings, 0, "", method.name, {}};
      for (; identity.trial < scenario.trials; ++identity.trial) {
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

bool DependsOnMachine(char letter) { return letter == 't' || letter == 'c' || letter == 'm'; }

Snapshot TakeSnapshot(const FinishedRun& run) {
  std::map<std::string, const Row*> rows;
  for (const Row& row : run.data.rows) rows.emplace(row.Id(), &row);
  Snapshot snapshot{run.data.suite, run.data.program_version, {}};
  for (const FinishedScenario& one : run.scenarios) snapshot.scenarios.push_back(TakeScenario(one, rows));
  return snapshot;
}

}  // namespace etude
