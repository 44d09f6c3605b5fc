#include "bench/scenario/sources.h"

#include <algorithm>
#include <filesystem>
#include <span>

#include "bench/scenario/scenario.h"
#include "bench/scenario/sweep.h"
#include "engine/document/fields.h"

namespace etude {
namespace {

constexpr std::size_t kMaxIncludeDepth = 8;
constexpr int kMaxInclusions = 100;
constexpr std::size_t kMaxScenarios = 1000;

using Entries = std::vector<Node::Entry>;

std::size_t CountAll(const Entries& entries) {
  std::size_t count = 0;
  for (const Node::Entry& entry : entries) count += CountValues(entry.value);
  return count;
}

/// Adds a key with its value. If the key exists, its value is replaced.
void Put(const Node::Entry& entry, Entries& entries) {
  const auto known =
      std::find_if(entries.begin(), entries.end(), [&](const auto& other) { return other.key == entry.key; });
  if (known == entries.end()) {
    entries.push_back(entry);
  } else {
    *known = entry;
  }
}

/// Returns true if `sweep` contains the parameter, alone or in a group of `together`.
bool Sweeps(const Node& sweep, const std::string& parameter) {
  const auto contains = [&](const Node& node) { return node.Find(parameter) != nullptr; };
  const Node* together = sweep.Find("together");
  return contains(sweep) ||
         (together != nullptr && (contains(*together) || std::ranges::any_of(together->items, contains)));
}

bool IsCommonKey(const std::string& key) {
  return std::ranges::any_of(CommonScenarioKeys(), [&](const KeyInfo& other) { return other.key == key; });
}

bool IsKeyOfFiles(const std::string& key) {
  return std::ranges::any_of(FileKeys(), [&](const KeyInfo& other) { return other.key == key; });
}

/// Collects the scenarios of a file. Follows `include` and `defaults`, with limits on depth and size.
class Collector {
 public:
  explicit Collector(const TextOf& text_of) : text_of_(text_of) {}

  Result<std::vector<Node>> Scenarios(const std::string& file) {
    // A file that contains only defaults is not a scenario file.
    ASSIGN_OR_RETURN(const auto top, Open(file, {file, 0, 0}));
    const Node* list = top.Find("scenarios");
    if (list == nullptr && top.Find("defaults") != nullptr) {
      return Fail(top.place,
                  "contains no scenario, only 'defaults'; move included files to a separate folder, such as shared/, "
                  "so that a run of this folder does not read them");
    }
    ASSIGN_OR_RETURN(auto defaults, DefaultsOf(top, file));
    // The file contains a single scenario.
    if (list == nullptr) {
      Node scenario = top;
      std::erase_if(scenario.entries, [](const auto& entry) { return entry.key == "include"; });
      ASSIGN_OR_RETURN(scenario, WithDefaults(std::move(scenario), defaults));
      return std::vector<Node>{std::move(scenario)};
    }
    // The file contains a list of scenarios. Check its keys and size.
    Fields fields(top, "a file of several scenarios");
    for (const KeyInfo& key : FileKeys()) fields.Raw(key.key);
    RETURN_IF_ERROR(fields.Finish());
    if (list->kind != Node::Kind::kSequence || list->items.empty()) {
      return Fail(list->place, "'scenarios' must be a list of at least one scenario, found {}", Describe(*list));
    }
    if (list->items.size() > kMaxScenarios) {
      return Fail(list->place, "found {} scenarios; allowed: at most {} in a file", list->items.size(), kMaxScenarios);
    }
    if (list->items.size() * CountAll(defaults) > kMaxFileValues) {
      return Fail(list->place,
                  "found {} scenarios, each with {} values from the defaults; allowed: at most {} values in all "
                  "scenarios together",
                  list->items.size(), CountAll(defaults), kMaxFileValues);
    }
    // Insert the defaults into each scenario.
    std::vector<Node> scenarios;
    for (const Node& item : list->items) {
      for (const Node::Entry& entry : item.entries) {
        if (!IsKeyOfFiles(entry.key)) continue;
        return Fail(entry.place, "'{}' is allowed only at the top level of a file, not in a scenario", entry.key);
      }
      ASSIGN_OR_RETURN(scenarios.emplace_back(), WithDefaults(item, defaults));
    }
    return scenarios;
  }

 private:
  /// Fails if a scenario's own key is also in its sweep, which would replace the key's value. The sweep may replace a
  /// default.
  static Result<Node> WithDefaults(Node scenario, const Entries& defaults) {
    if (scenario.kind != Node::Kind::kMapping) return scenario;  // the reader of the scenario reports the error
    const std::size_t own = scenario.entries.size();
    for (const Node::Entry& entry : defaults) {
      if (scenario.Find(entry.key) == nullptr) scenario.entries.push_back(entry);
    }
    const Node* sweep = scenario.Find("sweep");
    for (const Node::Entry& entry : std::span(scenario.entries).first(own)) {
      // ReadSweep reports a sweep of a common key.
      if (sweep == nullptr || IsCommonKey(entry.key) || !Sweeps(*sweep, entry.key)) continue;
      return Fail(entry.place, "'{}' is also in sweep; allowed: a value here or values in sweep, not both", entry.key);
    }
    return scenario;
  }

  Result<Node> Open(const std::string& file, const Place& asked_at) {
    ASSIGN_OR_RETURN(auto text, text_of_(file, asked_at));
    chain_.push_back(file);
    return ParseYaml(text, file);
  }

  /// Returns the keys that a file's scenarios receive from `include` and `defaults`.
  Result<Entries> DefaultsOf(const Node& top, const std::string& file) {
    Entries found;
    // Read the included files first. Keys of a later file replace keys of an earlier one.
    if (const Node* list = top.Find("include")) {
      const auto names = AsTexts(*list);
      if (!names) return Fail(names.error().place, "'include': {}", names.error().message);
      for (std::size_t i = 0; i < names->size(); ++i) {
        if ((*names)[i].empty()) return Fail(list->items[i].place, "the name of a file is empty");
        const auto path = std::filesystem::path(file).parent_path() / (*names)[i];
        auto included = Included(path.lexically_normal().string(), list->items[i].place);
        if (!included) return included;
        for (const Node::Entry& entry : *included) Put(entry, found);
      }
    }
    // The file's own defaults replace the defaults of included files.
    const Node* own = top.Find("defaults");
    if (own == nullptr) return found;
    if (own->kind != Node::Kind::kMapping) {
      return Fail(own->place, "'defaults' must be a mapping (key: value), found {}", Describe(*own));
    }
    for (const Node::Entry& entry : own->entries) {
      if (entry.key == "scenario" || IsKeyOfFiles(entry.key)) {
        return Fail(entry.place, "'{}' cannot be a default", entry.key);
      }
      Put(entry, found);
    }
    return found;
  }

  Result<Entries> Included(const std::string& file, const Place& asked_at) {
    if (std::find(chain_.begin(), chain_.end(), file) != chain_.end()) {
      return Fail(asked_at, "'{}' includes itself", file);
    }
    if (chain_.size() > kMaxIncludeDepth)
      return Fail(asked_at, "this inclusion is nested more than {} files deep", kMaxIncludeDepth);
    if (++inclusions_ > kMaxInclusions) return Fail(asked_at, "more than {} inclusions", kMaxInclusions);
    ASSIGN_OR_RETURN(const auto top, Open(file, asked_at));
    Fields fields(top, "an included file");
    for (const char* key : {"include", "defaults"}) fields.Raw(key);
    RETURN_IF_ERROR(fields.Finish());
    auto defaults = DefaultsOf(top, file);
    chain_.pop_back();
    return defaults;
  }

  const TextOf& text_of_;
  std::vector<std::string> chain_;  ///< the files from the scenario file to the file that is being read
  int inclusions_ = 0;
};

}  // namespace

std::span<const KeyInfo> FileKeys() {
  static const std::vector<KeyInfo> keys = {
      {"scenarios",
       {"a list of scenarios", fmt::format(R"({{"type":"array","minItems":1,"maxItems":{}}})", kMaxScenarios)},
       "",
       "The scenarios, in the order in which they run."},
      {"defaults",
       {"a mapping", R"({"type":"object"})"},
       "{}",
       "Default keys. Each scenario of this file gets the default keys that it lacks."},
      {"include", ListKind("a list of files", TextKind("")), "[]",
       "Files with more `defaults`. Paths are relative to this file. This key is also allowed in a file with a single "
       "scenario."}};
  return keys;
}

Result<std::vector<Node>> CollectScenarios(const std::string& file, const TextOf& text_of) {
  return Collector(text_of).Scenarios(file);
}

}  // namespace etude
