#include "bench/replay/verify_manifest.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>

#include "bench/run/manifest.h"
#include "io/files/files.h"
#include "io/files/json_text.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// The keys of a manifest that may differ on another machine or in another version. Only the types of their values are
/// checked.
constexpr std::array kSaidByMachine = {"etude", "compiler", "packages", "glibc", "libraries", "environment"};

bool IsTextOrTexts(const Json& value) {
  return value.is_string() ||
         (value.is_object() && std::ranges::all_of(value, [](const Json& one) { return one.is_string(); }));
}

/// Returns true if a scenario, or another text of the suite, refers to the text called `name`.
bool IsNamed(const std::string& name, const SuiteSetup& suite) {
  const std::string last = fs::path(name).filename().string();
  return std::ranges::any_of(suite.scenarios,
                             [&](const ScenarioSetup& one) {
                               return one.file == name || one.joint_map == name ||
                                      std::ranges::find(one.labels, name) != one.labels.end();
                             }) ||
         std::ranges::any_of(suite.sources, [&](const auto& other) {
           return other.first != name && other.second.find(last) != std::string::npos;
         });
}

/// Adds the faults of host.json, or of its part `path` about one shard, to `differences`: missing keys, unknown keys
/// and wrong types.
void CheckHost(const Json& host, const std::string& path, std::vector<std::string>& differences) {
  if (!host.is_object()) return differences.push_back(path + " is " + ShowJson(host));
  Json usual = DescribeHost("", 0, 0);
  for (const auto& [key, _] : usual.items()) {
    if (!host.contains(key)) differences.push_back(fmt::format("{}: '{}' is missing", path, key));
  }
  usual.update({{"fence", ""}, {"memory", ""}, {"shards", Json::array()}});  // keys that not every run has
  for (const auto& [key, value] : host.items()) {
    if (!usual.contains(key)) {
      differences.push_back(fmt::format("{}: no run writes '{}'", path, key));
    } else if (std::string_view(value.type_name()) != usual.at(key).type_name()) {
      differences.push_back(fmt::format("{}: '{}' is {}", path, key, ShowJson(value)));
    } else if (key == "shards") {
      for (std::size_t i = 0; i < value.size(); ++i) {
        CheckHost(value[i], fmt::format("{}: shards[{}]", path, i), differences);
      }
    }
  }
}

}  // namespace

Result<std::vector<Scenario>> ScenariosOf(const FilePath& folder) {
  ASSIGN_OR_RETURN(const auto suite, ReadManifest(folder / "manifest.json"));
  ParsedSuite parsed(suite);
  std::vector<Scenario> scenarios;
  for (const ScenarioSetup& setup : suite.scenarios) {
    ASSIGN_OR_RETURN(auto scenario, parsed.Find(setup));
    if (suite.scored) RETURN_IF_ERROR(AddScoredMethod(*suite.scored, scenario));
    scenarios.push_back(std::move(scenario));
  }
  return scenarios;
}

Result<Verified> VerifyManifest(const FilePath& folder, const FinishedRun& run, const SuiteSetup& suite,
                                std::span<const PreparedScenario> scenarios, const Json& programs) {
  Verified verified{"manifest.json: equal to the manifest that a run of its scenarios writes", {}};
  ASSIGN_OR_RETURN(const auto then, ReadJsonFile(folder / "manifest.json"));
  ASSIGN_OR_RETURN(auto now, MakeManifest(suite, scenarios, run.data.program_version));
  // Some values may differ: copy them from the old manifest to the new manifest.
  const auto keep = [](const Json& from, Json& to, const char* key) {
    if (to.contains(key) && from.contains(key) && IsTextOrTexts(from.at(key)) &&
        from.at(key).is_object() == to.at(key).is_object())
      to[key] = from.at(key);
  };
  for (const char* key : kSaidByMachine) keep(then, now, key);
  if (then.contains("scored") && now.contains("scored")) {
    for (const char* key : {"answers", "digest"}) {  // they describe the scored answers, which are not in the folder
      if (const Json& scored = then.at("scored"); scored.contains(key)) now["scored"][key] = scored.at(key);
    }
  }
  ASSIGN_OR_RETURN(const auto parsed, ScenariosOf(folder));
  const Json& told = then.at("scenarios");
  for (std::size_t s = 0; s < now["scenarios"].size() && s < told.size(); ++s) {
    Json& scenario = now["scenarios"][s];
    keep(told.at(s), scenario, "platform");
    if (!ProgramsIn(parsed.at(s)).empty()) {
      if (!told.at(s).contains("programs")) {
        verified.what += ", except the versions of its programs, which the etude of that run did not record";
      } else {
        scenario["programs"] = (programs.is_null() ? told : programs.at("scenarios")).at(s).at("programs");
      }
    }
    if (!scenarios.empty()) continue;
    for (const char* key : {"loaded_clips", "platform"}) {
      if (told.at(s).contains(key)) scenario[key] = told.at(s).at(key);
    }
  }
  // Everything else must have the same bytes, and every text of the suite must be used.
  ASSIGN_OR_RETURN(const auto text, WriteJson(now));
  ASSIGN_OR_RETURN(const auto found, ReadWholeFile(folder / "manifest.json"));
  if (found != text + "\n") {
    const auto differences = CompareManifests(then, now);
    verified.differences = {differences.empty() ? "differs from the text that a run writes" : InWords(differences)};
  }
  // The seed of the suite is the seed of all scenarios (--seed), or the default for scenarios without a seed of their
  // own.
  const auto has_its_seed = [&](const ScenarioSetup& one) { return one.seed.WithoutKey() == suite.seed.WithoutKey(); };
  if (suite.seed != Seed(1) && !std::ranges::all_of(suite.scenarios, has_its_seed))
    verified.differences.push_back("seed: it differs from the seeds of the scenarios");
  for (const auto& [name, _] : suite.sources) {
    if (!IsNamed(name, suite))
      verified.differences.push_back(fmt::format("sources: '{}' is used by no scenario and by no other source", name));
  }
  // The manifest's `own_metrics` are also in `now`, so the comparison above does not find superfluous ones. Report the
  // metrics that no scenario defines.
  std::set<std::string> own;
  for (const Scenario& scenario : parsed) {
    for (const OutsideMetric& metric : scenario.outside_metrics) own.insert(metric.info.id);
  }
  for (const Json& metric : then.value("own_metrics", Json::array())) {
    if (const std::string id = metric.at("id"); !own.contains(id)) {
      verified.differences.push_back(fmt::format("own_metrics: no scenario defines the metric '{}'", id));
    }
  }
  return verified;
}

namespace {

/// Adds a difference if host.json, or its part `path` about one shard, states another environment than the manifest.
void CompareEnvironment(const Json& manifest, const Json& host, const std::string& path,
                        std::vector<std::string>& differences) {
  const auto digest = manifest.find("environment"), pinned = host.find("pinned_environment");
  if (digest == manifest.end() || pinned == host.end() || !pinned->is_array()) return;
  if (!std::ranges::all_of(*pinned, [](const Json& one) { return one.is_string(); })) return;
  const std::string told = DigestOfEnvironment(pinned->get<std::vector<std::string>>());
  if (*digest == told) return;
  differences.push_back(
      fmt::format("{}: 'pinned_environment' has the digest {}, but 'environment' in manifest.json is {}", path, told,
                  ShowJson(*digest)));
}

}  // namespace

Result<Verified> VerifyHost(const FilePath& folder) {
  const FilePath path = folder / "host.json";
  Verified verified{"host.json: only keys that a run writes, and the environment of the manifest", {}};
  ASSIGN_OR_RETURN(const auto host, ReadJsonFile(path));
  ASSIGN_OR_RETURN(const auto manifest, ReadJsonFile(folder / "manifest.json"));
  CheckHost(host, path.string(), verified.differences);
  // A merged run was made by its shards, and the machine that merged them may be another one.
  Json shards = host.is_object() ? host.value("shards", Json::array()) : Json::array();
  if (!shards.is_array()) shards = Json::array();
  if (shards.empty() && host.is_object()) CompareEnvironment(manifest, host, path.string(), verified.differences);
  for (std::size_t i = 0; i < shards.size(); ++i) {
    if (!shards[i].is_object()) continue;
    CompareEnvironment(manifest, shards[i], fmt::format("{}: shards[{}]", path.string(), i), verified.differences);
  }
  ASSIGN_OR_RETURN(const auto text, WriteJson(host));
  ASSIGN_OR_RETURN(const auto found, ReadWholeFile(path));
  if (found != text + "\n") verified.differences.push_back(path.string() + " differs from the text that a run writes");
  return verified;
}

}  // namespace etude
