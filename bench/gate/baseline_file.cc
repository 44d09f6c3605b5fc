#include "bench/gate/baseline_file.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "bench/gate/placed_json.h"
#include "bench/metrics/catalogue.h"
#include "bench/results/row_json.h"
#include "engine/base/digest.h"
#include "engine/base/names.h"
#include "io/files/files.h"
#include "io/files/json.h"

namespace etude {
namespace {

Json EncodePairs(const NamedDigests& pairs) {
  Json json = Json::object();
  for (const auto& [name, digest] : pairs) json[name] = digest;
  return json;
}

Json EncodeScenario(const SnapshotScenario& scenario) {
  Json metrics = Json::object();
  for (const auto& [id, version] : scenario.metrics) metrics[id] = version;
  Json json{{"scenario", scenario.name},
            {"seed", scenario.seed},
            {"trials", scenario.trials},
            {"metrics", std::move(metrics)},
            {"worlds", EncodePairs(scenario.worlds)},
            {"methods", EncodePairs(scenario.methods)}};
  // The files are a list of pairs, because a list keeps their order.
  for (const auto& [name, truth] : scenario.files) json["files"].push_back({name, truth});
  return json;
}

Json IdentityOf(const SnapshotScenario& scenario, const SnapshotCells& cells) {
  return {{"scenario", scenario.name}, {"condition", cells.condition}, {"method", cells.method}};
}

Json EncodeValues(const SnapshotValues& kept) {
  Json values = Json::array();
  for (const auto& value : kept.values) values.push_back(value ? Json(*value) : Json(nullptr));
  return values;
}

/// Encodes what the cells were judged on: each list of parts once, and for each trial the number of its list, the rate
/// and the shares; null for a trial that does not state them.
Json EncodeJudgedCells(const std::vector<JudgedOn>& judged) {
  Json json{{"parts", Json::array()}, {"cells", Json::array()}};
  for (const JudgedOn& one : judged) {
    Json cell = one.parts.empty() ? Json(nullptr) : EncodeJudged(one);
    if (!one.parts.empty()) {
      Json& lists = json["parts"];
      const auto known = std::ranges::find(lists, cell["parts"]);
      const auto at = known - lists.begin();
      if (known == lists.end()) lists.push_back(cell["parts"]);
      cell["parts"] = at;
    }
    json["cells"].push_back(std::move(cell));
  }
  return json;
}

/// Collects the entries of a JSON array and writes one per line.
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

// The status letters that may occur in a baseline. The letters 'm' (out of memory), 't' (timeout) and 'c' (crashed) are
// missing, because no baseline is made of a run with such a cell.
constexpr std::string_view kLetters = "oufbs";
constexpr std::string_view kAnswers = "ou";     // letters of the statuses that have an answer
constexpr std::int64_t kMaxTrials = 1'000'000;  // the largest number of trials that a scenario file may state
constexpr std::int64_t kMaxVersions = 1'000'000;

/// Returns the seal of a baseline: the digest of its JSON values without the key `seal`. White space in the file does
/// not affect the digest.
Result<std::string> SealOf(Json baseline) {
  baseline.erase("seal");
  ASSIGN_OR_RETURN(const auto text, WriteJson(baseline));
  return Digest().Add(std::string_view(text)).Hex();
}

/// The cells of one scenario, condition and method. In the file, one line holds their statuses, and one line per metric
/// holds their values.
struct Slot {
  std::size_t trials = 0;
  SnapshotCells* cells = nullptr;
};
/// Slots, keyed by the text "scenario, condition, method".
using Slots = std::map<std::string, Slot>;

class BaselineReader {
 public:
  BaselineReader(std::string file, JsonPlaces places, BaselineSeal seal)
      : file_(std::move(file)), places_(std::move(places)), seal_(seal) {}

  Result<Snapshot> Read(const Json& json) {
    // Check the schema, and that a seal is present if the schema requires one.
    ASSIGN_OR_RETURN(const auto head,
                     JsonObject::Of(json, PlaceOf("", 0), "a baseline",
                                    {"schema", "etude", "suite", "scenarios", "statuses", "values"}, {"seal"}));
    ASSIGN_OR_RETURN(const auto schema, head.Whole("schema", 0, kMaxVersions));
    if (schema != kBaselineSchema && schema != kUnsealedSchema) {
      return Fail(head.place(), "schema {}; allowed: {} and {}", schema, kUnsealedSchema, kBaselineSchema);
    }
    const bool is_sealed = schema != kUnsealedSchema;
    if (is_sealed != head.Has("seal")) {
      return Fail(head.place(), "a baseline of schema {} {}", schema, is_sealed ? "lacks its 'seal'" : "has a 'seal'");
    }
    // Read the scenarios, which say which cells exist, and then the lines with the cells' statuses and values.
    ASSIGN_OR_RETURN(snapshot_.suite, head.Text("suite"));
    ASSIGN_OR_RETURN(snapshot_.program_version, head.Text("etude"));
    RETURN_IF_ERROR(ForEach(head, "scenarios",
                            [this](const Json& entry, const Place& place) { return ReadScenario(entry, place); }));
    if (snapshot_.scenarios.empty()) return Fail(head.place(), "contains no scenario; allowed: one or more");
    RETURN_IF_ERROR(CountLines(head));
    MakeSlots();
    RETURN_IF_ERROR(ForEach(head, "statuses",
                            [this](const Json& entry, const Place& place) { return ReadStatuses(entry, place); }));
    RETURN_IF_ERROR(
        ForEach(head, "values", [this](const Json& entry, const Place& place) { return ReadValues(entry, place); }));
    // Fail if no cell has an answer, or if the seal does not match.
    const auto has_answer = [](const auto& slot) {
      return slot.second.cells->statuses.find_first_of(kAnswers) != std::string::npos;
    };
    if (!std::ranges::any_of(slots_, has_answer)) {
      return Fail(head.place(), "no cell has the status ok or unsolved, so no run could be worse than this baseline");
    }
    RETURN_IF_ERROR(CheckSeal(json, head));
    return std::move(snapshot_);
  }

 private:
  Result<void> CheckSeal(const Json& json, const JsonObject& head) {
    if (!head.Has("seal")) {
      snapshot_.unsealed =
          file_ +
          ": an older version of etude wrote this baseline without a seal; gate --update writes a baseline with a seal";
      if (seal_ == BaselineSeal::kMayBreak) return {};
      return Fail({}, "{}; --unsealed reads the baseline anyway", snapshot_.unsealed);
    }
    ASSIGN_OR_RETURN(const auto told, head.Text("seal"));
    ASSIGN_OR_RETURN(const auto found, SealOf(json));
    if (told == found) return {};
    snapshot_.unsealed = file_ + ": the seal does not match, so this baseline was changed after gate --update wrote it";
    if (seal_ == BaselineSeal::kMayBreak) return {};
    return Fail({}, "{}; --unsealed reads the baseline anyway", snapshot_.unsealed);
  }

  Place PlaceOf(const std::string& list, std::size_t entry) const {
    const auto found = places_.lines.find(list);
    const bool known = found != places_.lines.end() && entry < found->second.size();
    return {file_, known ? found->second[entry] : 0, 0};
  }

  Result<void> ForEach(const JsonObject& head, const std::string& list,
                       const std::function<Result<void>(const Json&, const Place&)>& read) const {
    ASSIGN_OR_RETURN(const Json* entries, head.List(list));
    for (std::size_t i = 0; i < entries->size(); ++i) {
      RETURN_IF_ERROR(read((*entries)[i], PlaceOf(list, i)));
    }
    return {};
  }

  Result<void> ReadScenario(const Json& entry, const Place& place) {
    ASSIGN_OR_RETURN(const auto line,
                     JsonObject::Of(entry, place, "a scenario",
                                    {"scenario", "seed", "trials", "metrics", "worlds", "methods"}, {"files"}));
    // Read name, seed and trials.
    SnapshotScenario scenario;
    ASSIGN_OR_RETURN(scenario.name, line.Text("scenario"));
    for (const SnapshotScenario& other : snapshot_.scenarios) {
      if (other.name == scenario.name)
        return Fail(place, "two scenarios are named {}; names must be unique", Quote(scenario.name));
    }
    ASSIGN_OR_RETURN(scenario.seed, line.Unsigned("seed"));
    ASSIGN_OR_RETURN(const auto trials, line.Whole("trials", 1, kMaxTrials));
    scenario.trials = static_cast<int>(trials);
    // Read the digests of worlds and methods, and the versions of metrics.
    const auto read_digests = [&](std::string_view key, NamedDigests& digests) {
      return line.Each(key, [&](const std::string& name, const JsonObject& inner) -> Result<void> {
        ASSIGN_OR_RETURN(auto digest, inner.Text(name));
        digests.emplace_back(name, std::move(digest));
        return {};
      });
    };
    RETURN_IF_ERROR(read_digests("worlds", scenario.worlds));
    RETURN_IF_ERROR(read_digests("methods", scenario.methods));
    RETURN_IF_ERROR(ReadFiles(line, scenario));
    RETURN_IF_ERROR(line.Each("metrics", [&](const std::string& id, const JsonObject& inner) -> Result<void> {
      if (FindMetric(id) == nullptr) {
        return Fail(place, "scenario {} has an unknown metric {}", Quote(scenario.name), Quote(id));
      }
      ASSIGN_OR_RETURN(const auto version, inner.Whole(id, 1, kMaxVersions));
      scenario.metrics.emplace_back(id, static_cast<int>(version));
      return {};
    }));
    snapshot_.scenarios.push_back(std::move(scenario));
    return {};
  }

  /// Reads, for a task that judges files, the names of the worlds and the digests of their ground truths.
  static Result<void> ReadFiles(const JsonObject& line, SnapshotScenario& scenario) {
    if (!line.Has("files")) return {};
    ASSIGN_OR_RETURN(const Json* files, line.List("files"));
    for (const Json& file : *files) {
      if (!file.is_array() || file.size() != 2 || !file[0].is_string() || !file[1].is_string()) {
        return Fail(line.place(), "'files' must list pairs of a name and a digest, found {}", DescribeJson(file));
      }
      scenario.files.emplace_back(file[0].get<std::string>(), file[1].get<std::string>());
    }
    if (scenario.files.size() == static_cast<std::size_t>(scenario.trials)) return {};
    return Fail(line.place(), "'files' lists {} files, but the scenario has {} trials", scenario.files.size(),
                scenario.trials);
  }

  /// Checks the number of lines before the table of cells is allocated, because two long lists of names in a small file
  /// could declare a huge table. Duplicate lines are refused, so every cell has a line if there are as many lines as
  /// cells.
  Result<void> CountLines(const JsonObject& head) const {
    std::size_t cells = 0, lists = 0;
    for (const SnapshotScenario& scenario : snapshot_.scenarios) {
      cells += scenario.worlds.size() * scenario.methods.size();
      lists += scenario.worlds.size() * scenario.methods.size() * scenario.metrics.size();
    }
    ASSIGN_OR_RETURN(const Json* statuses, head.List("statuses"));
    ASSIGN_OR_RETURN(const Json* values, head.List("values"));
    if (statuses->size() == cells && values->size() == lists) return {};
    return Fail(head.place(),
                "contains {} lines of statuses and {} lines of values, but its scenarios need {} lines of statuses and "
                "{} lines of values",
                statuses->size(), values->size(), cells, lists);
  }

  void MakeSlots() {
    for (SnapshotScenario& scenario : snapshot_.scenarios) {
      for (const auto& [condition, world] : scenario.worlds) {
        for (const auto& [method, settings] : scenario.methods) {
          SnapshotCells& cells = scenario.cells.emplace_back(SnapshotCells{condition, method, "", {}});
          for (const auto& [id, version] : scenario.metrics) cells.metrics.push_back({id, {}});
        }
      }
      for (SnapshotCells& cells : scenario.cells) {
        slots_[fmt::format("{}, {}, {}", scenario.name, cells.condition, cells.method)] = {
            static_cast<std::size_t>(scenario.trials), &cells};
      }
    }
  }

  Result<Slots::const_iterator> FindSlot(const JsonObject& line, std::string_view what) const {
    ASSIGN_OR_RETURN(const auto scenario, line.Text("scenario"));
    ASSIGN_OR_RETURN(const auto condition, line.Text("condition"));
    ASSIGN_OR_RETURN(const auto method, line.Text("method"));
    const std::string name = fmt::format("{}, {}, {}", scenario, condition, method);
    const auto slot = slots_.find(name);
    if (slot == slots_.end())
      return Fail(line.place(), "contains {} for {}, but no scenario has these cells", what, name);
    return slot;
  }

  Result<void> ReadStatuses(const Json& entry, const Place& place) {
    ASSIGN_OR_RETURN(const auto line, JsonObject::Of(entry, place, "a line of statuses",
                                                     {"scenario", "condition", "method", "cells"}, {"judged"}));
    ASSIGN_OR_RETURN(const auto slot, FindSlot(line, "statuses"));
    const auto& [name, cells] = *slot;
    std::string& statuses = cells.cells->statuses;
    if (!statuses.empty()) return Fail(place, "two lines contain the statuses of {}; allowed: one line", name);
    ASSIGN_OR_RETURN(statuses, line.Text("cells"));
    if (statuses.find_first_not_of(kLetters) != std::string::npos || statuses.size() != cells.trials) {
      return Fail(place, "the statuses of {} must be {} letters, each one of '{}'", name, cells.trials, kLetters);
    }
    if (line.Has("judged")) RETURN_IF_ERROR(ReadJudged(entry.at("judged"), place, name, cells));
    // A method whose cells were all skipped needs no answer.
    const bool skipped = statuses.find_first_not_of('s') == std::string::npos;
    if (skipped || statuses.find_first_of(kAnswers) != std::string::npos) return {};
    return Fail(place,
                "all {} cells of {} failed, so no run could be worse than this baseline; needed: at least one cell "
                "with the status ok or unsolved, or only skipped cells",
                cells.trials, name);
  }

  /// Reads what the cells were judged on (EncodeJudgedCells).
  static Result<void> ReadJudged(const Json& json, const Place& place, const std::string& name, const Slot& slot) {
    try {
      for (Json cell : json.at("cells")) {
        JudgedOn& judged = slot.cells->judged.emplace_back();
        if (cell.is_null()) continue;
        cell["parts"] = json.at("parts").at(cell.at("parts").get<std::size_t>());
        judged = DecodeJudged(cell);
      }
    } catch (const Json::exception& error) {
      return Fail(place, "the key 'judged' of {} cannot be read: {}", name, error.what());
    }
    if (slot.cells->judged.size() == slot.trials) return {};
    return Fail(place, "the key 'judged' of {} describes {} cells, but the scenario has {} trials", name,
                slot.cells->judged.size(), slot.trials);
  }

  Result<void> ReadValues(const Json& entry, const Place& place) {
    ASSIGN_OR_RETURN(const auto line,
                     JsonObject::Of(entry, place, "a line of values",
                                    {"scenario", "condition", "method", "metric", "values"}, {"nulls"}));
    ASSIGN_OR_RETURN(const auto slot, FindSlot(line, "values"));
    ASSIGN_OR_RETURN(const auto metric, line.Text("metric"));
    const auto& [name, cells] = *slot;
    const auto kept = std::ranges::find(cells.cells->metrics, metric, &SnapshotValues::metric);
    if (kept == cells.cells->metrics.end()) {
      return Fail(place, "contains values of {} for {}, but the scenario does not list this metric", metric, name);
    }
    if (!kept->values.empty())
      return Fail(place, "two lines contain the values of {} for {}; allowed: one line", metric, name);
    ASSIGN_OR_RETURN(const Json* values, line.List("values"));
    if (values->size() != cells.trials) {
      return Fail(place, "contains {} values of {} for {}, but the scenario has {} trials", values->size(), metric,
                  name, cells.trials);
    }
    for (std::size_t trial = 0; trial < cells.trials; ++trial) {
      const Json& value = (*values)[trial];
      if (!value.is_null() && !value.is_number()) {
        return Fail(place, "the value of {} for {} in trial {} is {}; allowed: a number or null", metric, name, trial,
                    DescribeJson(value));
      }
      kept->values.push_back(value.is_null() ? std::nullopt : std::optional(value.get<double>()));
    }
    return CheckNulls(line, *kept, name);
  }

  /// Fails if the number of missing values (null) differs from the number that the line declares. A world with a null
  /// cannot get worse, so an additional null would weaken the gate.
  Result<void> CheckNulls(const JsonObject& line, const SnapshotValues& kept, const std::string& name) const {
    std::int64_t allowed = 0;
    if (line.Has("nulls")) {
      ASSIGN_OR_RETURN(allowed, line.Whole("nulls", 1, static_cast<std::int64_t>(kept.values.size())));
    }
    const auto found = std::ranges::count(kept.values, std::optional<double>());
    if (found == allowed) return {};
    const auto first = std::ranges::find(kept.values, std::optional<double>()) - kept.values.begin();
    return Fail(line.place(),
                "{} values of {} for {} are null{}; allowed: {}, the number in the key 'nulls' of this line (0 without "
                "this key)",
                found, kept.metric, name, found == 0 ? "" : fmt::format(", the first in trial {}", first), allowed);
  }

  std::string file_;
  JsonPlaces places_;
  BaselineSeal seal_;
  Snapshot snapshot_;
  Slots slots_;
};

}  // namespace

Result<std::string> WriteBaseline(const Snapshot& snapshot) {
  // Write each scenario as a line, and each method's statuses and metrics as further lines.
  Lines scenarios, statuses, values;
  for (const SnapshotScenario& scenario : snapshot.scenarios) {
    scenarios.Add(EncodeScenario(scenario));
    for (const SnapshotCells& cells : scenario.cells) {
      const Json identity = IdentityOf(scenario, cells);
      Json line = identity;
      line["cells"] = cells.statuses;
      if (!cells.judged.empty()) line["judged"] = EncodeJudgedCells(cells.judged);
      statuses.Add(line);
      for (const SnapshotValues& kept : cells.metrics) {
        line = identity;
        line["metric"] = kept.metric;
        if (const auto nulls = std::ranges::count(kept.values, std::optional<double>()); nulls > 0)
          line["nulls"] = nulls;
        line["values"] = EncodeValues(kept);
        values.Add(line);
      }
    }
  }
  for (const Lines* lines : {&scenarios, &statuses, &values}) {
    if (lines->error()) return tl::unexpected(*lines->error());
  }
  // Join the lines and append the seal.
  auto head = WriteJson({{"schema", kBaselineSchema}, {"etude", snapshot.program_version}, {"suite", snapshot.suite}});
  if (!head) return head;
  head->pop_back();  // removes the closing brace
  const std::string text = fmt::format("{},\n\"scenarios\":[{}\n],\n\"statuses\":[{}\n],\n\"values\":[{}\n]", *head,
                                       scenarios.text(), statuses.text(), values.text());
  ASSIGN_OR_RETURN(const auto json, ReadJson(text + "}", "a baseline"));
  ASSIGN_OR_RETURN(const auto seal, SealOf(json));
  return fmt::format("{},\n\"seal\":\"{}\"}}\n", text, seal);
}

Result<Snapshot> LoadBaseline(const std::filesystem::path& path, BaselineSeal seal) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(path));
  return ReadBaseline(text, path.string(), seal);
}

Result<Snapshot> ReadBaseline(const std::string& text, const std::string& file, BaselineSeal seal) {
  ASSIGN_OR_RETURN(const auto json, ReadJson(text, file));
  ASSIGN_OR_RETURN(auto places, FindJsonPlaces(text, file));
  return BaselineReader(file, std::move(places), seal).Read(json);
}

}  // namespace etude
