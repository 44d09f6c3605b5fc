#include "bench/gate/finished_run.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/files/files.h"
#include "bench/metrics/catalogue.h"
#include "bench/results/folder.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Values of two versions of a metric never mix.
Result<void> CheckMetricVersions(const Json& manifest, const Place& place) {
  const Json versions = manifest.value("metrics", Json::object());
  for (const auto& [id, version] : versions.items()) {
    const MetricInfo* metric = FindMetric(id);
    if (metric != nullptr && version != metric->version) {
      return Fail(place, "was measured with version {} of {}; this program has version {}: run it anew", version.dump(),
                  id, metric->version);
    }
  }
  return {};
}

/// The scenarios of manifest.json, read from the texts that it keeps.
Result<std::vector<FinishedScenario>> LoadScenarios(const fs::path& path) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(path));
  ASSIGN_OR_RETURN(const auto manifest, ReadJson(text, path.string()));
  const Place place{path.string(), 0, 0};
  ASSIGN_OR_RETURN(auto suite, DecodeSetup(manifest, place));
  RETURN_IF_ERROR(CheckMetricVersions(manifest, place));
  std::vector<FinishedScenario> finished;
  for (std::size_t s = 0; s < suite.scenarios.size(); ++s) {
    FinishedScenario& one = finished.emplace_back();
    one.setup = suite.scenarios[s];
    ASSIGN_OR_RETURN(auto parsed, ParseScenarios(one.setup.file, suite.sources));
    const auto named = std::find_if(parsed.begin(), parsed.end(),
                                    [&](const Scenario& scenario) { return scenario.name == one.setup.name; });
    if (named == parsed.end()) return Fail(place, "'{}' holds no scenario '{}'", one.setup.file, one.setup.name);
    one.scenario = std::move(*named);
    one.scenario.trials = one.setup.trials;
    if (suite.scored) {
      RETURN_IF_ERROR(AddScoredMethod(*suite.scored, one.scenario));
    }
    try {
      for (const Json& clip : manifest.at("scenarios").at(s).at("loaded_clips")) {
        one.clip_digests.push_back(clip.at("digest").get<std::string>());
      }
    } catch (const Json::exception& error) {
      return Fail(place, "not a manifest: {}", error.what());
    }
  }
  return finished;
}

/// The identities of all cells that a scenario asks for, in canonical order.
std::vector<std::string> CellsOf(const Scenario& scenario) {
  std::vector<std::string> ids;
  Row row;
  row.scenario = scenario.name;
  for (const Condition& condition : scenario.conditions) {
    row.condition = condition.settings;
    for (row.trial = 0; row.trial < scenario.trials; ++row.trial) {
      for (const MethodEntry& method : scenario.methods) {
        row.method = method.name;
        ids.push_back(row.Id());
      }
    }
  }
  return ids;
}

bool WantsTimes(const FinishedScenario& scenario) { return !scenario.scenario.gate.time_ratios.empty(); }

}  // namespace

Result<void> CheckRows(FinishedRun& run, const Place& place) {
  std::set<std::string> rows;
  for (const Row& row : run.data.rows) {
    if (!rows.insert(row.Id()).second) return Fail(place, "holds the cell {} twice", row.Id());
  }
  for (const FinishedScenario& one : run.scenarios) {
    const std::vector<std::string> wanted = CellsOf(one.scenario);
    std::vector<std::string> missing;
    for (const std::string& id : wanted) {
      if (rows.erase(id) == 0) missing.push_back(id);
    }
    if (missing.empty()) continue;
    run.incomplete.push_back(fmt::format("{}: {} of {} rows are missing, the first is {}", one.scenario.name,
                                         missing.size(), wanted.size(), missing.front()));
  }
  if (!rows.empty()) return Fail(place, "holds the cell {}, which no scenario of the manifest asks for", *rows.begin());
  return {};
}

Result<FinishedRun> LoadFinishedRun(const fs::path& folder) {
  FinishedRun run;
  std::error_code none;
  if (fs::exists(folder / kJournalFile, none)) {
    run.incomplete.push_back(
        fmt::format("the run did not come to its end, or is still under way ({} is there)", kJournalFile));
    return run;
  }
  ASSIGN_OR_RETURN(auto data, LoadRun(folder));
  run.data = std::move(data);
  ASSIGN_OR_RETURN(auto scenarios, LoadScenarios(folder / "manifest.json"));
  run.scenarios = std::move(scenarios);
  RETURN_IF_ERROR(CheckRows(run, {(folder / "cells.jsonl").string(), 0, 0}));
  if (run.data.cpu_seconds.empty() && std::any_of(run.scenarios.begin(), run.scenarios.end(), WantsTimes)) {
    return Fail({(folder / "timings.jsonl").string(), 0, 0}, "tells no times, which a gate of this run needs");
  }
  return run;
}

}  // namespace etude
