#include "bench/finished_runs/finish_scenario.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "bench/scenario/scenario.h"
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
std::string WorldDigest(const std::string& task, const Node& condition, std::span<const std::string> clip_digests) {
  Digest digest;
  digest.Add(std::string_view(task));
  std::vector<const Node::Entry*> own;
  for (const Node::Entry& entry : condition.entries) {
    if (!IsCommonKey(entry.key)) own.push_back(&entry);
  }
  std::sort(own.begin(), own.end(), [](const auto* a, const auto* b) { return a->key < b->key; });  // keys are unique
  for (const Node::Entry* entry : own) {
    digest.Add(std::string_view(entry->key)).Add(std::string_view("\0", 1));
    AddNode(digest, entry->value);
  }
  for (const std::string& clip : clip_digests) digest.Add(std::string_view(clip));
  return digest.Hex();
}

std::string MethodDigest(const MethodEntry& method) {
  Digest digest;
  AddNode(digest, method.node);
  for (const std::string& argument : method.exec) digest.Add(std::string_view(argument)).Add(std::string_view("\0", 1));
  digest.Add(std::string_view(method.options_json));
  return digest.Hex();
}

}  // namespace

FinishedScenario FinishScenario(const Scenario& scenario, const ScenarioSetup& setup,
                                std::span<const std::string> clip_digests) {
  FinishedScenario finished{.study = StudyOf(scenario), .seed = setup.seed, .worlds = {}, .methods = {}};
  for (const Condition& condition : scenario.conditions) {
    finished.worlds.emplace_back(CompactLabel(condition.swept),
                                 WorldDigest(scenario.task, condition.node, clip_digests));
  }
  for (const MethodEntry& method : scenario.methods) finished.methods.emplace_back(method.name, MethodDigest(method));
  return finished;
}

}  // namespace etude
