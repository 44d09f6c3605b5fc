#include "bench/gate/baseline_file.h"

#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bench/files/files.h"
#include "bench/files/json.h"
#include "bench/metrics/catalogue.h"

namespace etude {
namespace {

constexpr std::string_view kLetters = "ouftcmbs";
constexpr int kMostTrials = 1'000'000;  // as a scenario may ask for

Json EncodePairs(const NamedDigests& pairs) {
  Json json = Json::object();
  for (const auto& [name, digest] : pairs) json[name] = digest;
  return json;
}

NamedDigests DecodePairs(const Json& json) {
  NamedDigests pairs;
  for (const auto& [name, digest] : json.items()) pairs.emplace_back(name, digest.get<std::string>());
  return pairs;
}

Json EncodeScenario(const SnapshotScenario& scenario) {
  Json metrics = Json::object();
  for (const auto& [id, version] : scenario.metrics) metrics[id] = version;
  return {{"scenario", scenario.name},
          {"seed", scenario.seed},
          {"trials", scenario.trials},
          {"metrics", std::move(metrics)},
          {"worlds", EncodePairs(scenario.worlds)},
          {"methods", EncodePairs(scenario.methods)}};
}

Json IdentityOf(const SnapshotScenario& scenario, const SnapshotCells& cells) {
  return {{"scenario", scenario.name}, {"condition", cells.condition}, {"method", cells.method}};
}

Json EncodeValues(const SnapshotValues& kept) {
  Json values = Json::array();
  for (const auto& value : kept.values) values.push_back(value ? Json(*value) : Json(nullptr));
  return values;
}

/// The lines of an array, one value each.
class Lines {
 public:
  void Add(const Json& json) {
    const auto text = WriteJson(json);
    if (!text && !error_) error_ = text.error();
    if (text) text_ += (text_.empty() ? "\n" : ",\n") + *text;
  }
  const std::string& text() const { return text_; }
  const std::optional<Error>& error() const { return error_; }

 private:
  std::string text_;
  std::optional<Error> error_;
};

SnapshotScenario DecodeScenario(const Json& json) {
  SnapshotScenario scenario;
  scenario.name = json.at("scenario").get<std::string>();
  scenario.seed = json.at("seed").get<std::uint64_t>();
  scenario.trials = json.at("trials").get<int>();
  for (const auto& [id, version] : json.at("metrics").items()) scenario.metrics.emplace_back(id, version.get<int>());
  scenario.worlds = DecodePairs(json.at("worlds"));
  scenario.methods = DecodePairs(json.at("methods"));
  return scenario;
}

/// Makes an empty place for each line that must follow.
void MakePlaces(SnapshotScenario& scenario) {
  for (const auto& [condition, world] : scenario.worlds) {
    for (const auto& [method, settings] : scenario.methods) {
      SnapshotCells& cells = scenario.cells.emplace_back(SnapshotCells{condition, method, "", {}});
      for (const auto& [id, version] : scenario.metrics) cells.metrics.push_back({id, {}});
    }
  }
}

/// The cells that a line can be about, by "scenario, condition, method".
struct Slot {
  int trials = 0;
  SnapshotCells* cells = nullptr;
};
using Slots = std::map<std::string, Slot>;

std::string SlotName(const std::string& scenario, const std::string& condition, const std::string& method) {
  return fmt::format("{}, {}, {}", scenario, condition, method);
}

std::string SlotName(const Json& line) {
  return SlotName(line.at("scenario").get<std::string>(), line.at("condition").get<std::string>(),
                  line.at("method").get<std::string>());
}

Slots SlotsOf(Snapshot& snapshot) {
  Slots slots;
  for (SnapshotScenario& scenario : snapshot.scenarios) {
    for (SnapshotCells& cells : scenario.cells) {
      slots[SlotName(scenario.name, cells.condition, cells.method)] = {scenario.trials, &cells};
    }
  }
  return slots;
}

Result<void> ReadStatuses(const Json& line, const Place& place, const Slots& slots) {
  const std::string name = SlotName(line);
  const auto slot = slots.find(name);
  if (slot == slots.end()) return Fail(place, "statuses of {}, which no scenario has", name);
  const auto& [trials, cells] = slot->second;
  if (!cells->statuses.empty()) return Fail(place, "two lines of statuses of {}", name);
  cells->statuses = line.at("cells").get<std::string>();
  const bool known = cells->statuses.find_first_not_of(kLetters) == std::string::npos;
  if (known && cells->statuses.size() == static_cast<std::size_t>(trials)) return {};
  return Fail(place, "the statuses of {} are not {} letters of '{}'", name, trials, kLetters);
}

Result<void> ReadValues(const Json& line, const Place& place, const Slots& slots) {
  const std::string name = SlotName(line);
  const auto metric = line.at("metric").get<std::string>();
  const auto slot = slots.find(name);
  if (slot == slots.end()) return Fail(place, "values of {}, which no scenario has", name);
  const auto& [trials, cells] = slot->second;
  for (SnapshotValues& kept : cells->metrics) {
    if (kept.metric != metric) continue;
    if (!kept.values.empty()) return Fail(place, "two lines of {} of {}", metric, name);
    for (const Json& value : line.at("values")) {
      kept.values.push_back(value.is_null() ? std::nullopt : std::optional(value.get<double>()));
    }
    if (kept.values.size() == static_cast<std::size_t>(trials)) return {};
    return Fail(place, "{} values of {} of {}; it has {} trials", kept.values.size(), metric, name, trials);
  }
  return Fail(place, "values of {} of {}, a metric that its scenario does not list", metric, name);
}

Result<void> CheckScenario(const SnapshotScenario& scenario, const Snapshot& snapshot, const Place& place) {
  for (const SnapshotScenario& other : snapshot.scenarios) {
    if (other.name == scenario.name) return Fail(place, "two scenarios '{}'", scenario.name);
  }
  if (scenario.trials < 1 || scenario.trials > kMostTrials) {
    return Fail(place, "scenario '{}' has {} trials; allowed: 1…{}", scenario.name, scenario.trials, kMostTrials);
  }
  for (const auto& [id, version] : scenario.metrics) {
    if (FindMetric(id) == nullptr) return Fail(place, "scenario '{}' has an unknown metric '{}'", scenario.name, id);
  }
  return {};
}

Result<void> FillCells(const Json& json, const Place& place, Snapshot& snapshot) {
  const Json &statuses = json.at("statuses"), &values = json.at("values");
  // Counted before allocating: two long lists of names in a small file would make a huge table. No line may come
  // twice, so a file with as many lines as cells fills every cell.
  std::size_t cells = 0, lists = 0;
  for (const SnapshotScenario& scenario : snapshot.scenarios) {
    cells += scenario.worlds.size() * scenario.methods.size();
    lists += scenario.worlds.size() * scenario.methods.size() * scenario.metrics.size();
  }
  if (statuses.size() != cells || values.size() != lists) {
    return Fail(place, "{} lines of statuses and {} of values; its scenarios have {} and {}", statuses.size(),
                values.size(), cells, lists);
  }
  for (SnapshotScenario& scenario : snapshot.scenarios) MakePlaces(scenario);
  const Slots slots = SlotsOf(snapshot);
  for (const Json& line : statuses) {
    RETURN_IF_ERROR(ReadStatuses(line, place, slots));
  }
  for (const Json& line : values) {
    RETURN_IF_ERROR(ReadValues(line, place, slots));
  }
  return {};
}

}  // namespace

Result<std::string> WriteBaseline(const Snapshot& snapshot) {
  Lines scenarios, statuses, values;
  for (const SnapshotScenario& scenario : snapshot.scenarios) {
    scenarios.Add(EncodeScenario(scenario));
    for (const SnapshotCells& cells : scenario.cells) {
      const Json identity = IdentityOf(scenario, cells);
      Json line = identity;
      line["cells"] = cells.statuses;
      statuses.Add(line);
      for (const SnapshotValues& kept : cells.metrics) {
        line = identity;
        line["metric"] = kept.metric;
        line["values"] = EncodeValues(kept);
        values.Add(line);
      }
    }
  }
  for (const Lines* lines : {&scenarios, &statuses, &values}) {
    if (lines->error()) return tl::unexpected(*lines->error());
  }
  auto head = WriteJson({{"schema", kBaselineSchema}, {"etude", snapshot.program_version}, {"suite", snapshot.suite}});
  if (!head) return head;
  head->pop_back();  // its brace, to go on in it
  return fmt::format("{},\n\"scenarios\":[{}\n],\n\"statuses\":[{}\n],\n\"values\":[{}\n]}}\n", *head, scenarios.text(),
                     statuses.text(), values.text());
}

Result<Snapshot> ReadBaseline(const std::string& text, const std::string& file) {
  ASSIGN_OR_RETURN(const auto json, ReadJson(text, file));
  const Place place{file, 0, 0};
  Snapshot snapshot;
  try {
    const int schema = json.at("schema").get<int>();
    if (schema != kBaselineSchema) return Fail(place, "schema {}; this program reads {}", schema, kBaselineSchema);
    snapshot.suite = json.at("suite").get<std::string>();
    snapshot.program_version = json.at("etude").get<std::string>();
    for (const Json& entry : json.at("scenarios")) {
      SnapshotScenario scenario = DecodeScenario(entry);
      RETURN_IF_ERROR(CheckScenario(scenario, snapshot, place));
      snapshot.scenarios.push_back(std::move(scenario));
    }
    RETURN_IF_ERROR(FillCells(json, place, snapshot));
  } catch (const Json::exception& error) {
    return Fail(place, "not a baseline: {}", error.what());
  }
  return snapshot;
}

Result<Snapshot> LoadBaseline(const std::filesystem::path& path) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(path));
  return ReadBaseline(text, path.string());
}

}  // namespace etude
