#include "bench/finished_runs/load.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/files/files.h"
#include "bench/finished_runs/finish_scenario.h"
#include "bench/metrics/catalogue.h"

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
  ASSIGN_OR_RETURN(const auto suite, DecodeSetup(manifest, place));
  RETURN_IF_ERROR(CheckMetricVersions(manifest, place));
  std::vector<FinishedScenario> finished;
  ParsedSuite parsed(suite);
  for (std::size_t s = 0; s < suite.scenarios.size(); ++s) {
    const ScenarioSetup& setup = suite.scenarios[s];
    ASSIGN_OR_RETURN(auto scenario, parsed.Find(setup));
    if (suite.scored) {
      RETURN_IF_ERROR(AddScoredMethod(*suite.scored, scenario));
    }
    std::vector<std::string> clip_digests;
    try {
      for (const Json& clip : manifest.at("scenarios").at(s).at("loaded_clips")) {
        clip_digests.push_back(clip.at("digest").get<std::string>());
      }
    } catch (const Json::exception& error) {
      return Fail(place, "not a manifest: {}", error.what());
    }
    finished.push_back(FinishScenario(scenario, setup, clip_digests));
  }
  return finished;
}

bool WantsTimes(const FinishedScenario& scenario) { return !scenario.study.gate.time_ratios.empty(); }

}  // namespace

Result<FinishedRun> LoadFinishedRun(const fs::path& folder, Sealing sealing) {
  FinishedRun run;
  std::error_code none;
  if (fs::exists(folder / kJournalFile, none)) {
    run.incomplete.push_back(
        fmt::format("the run did not come to its end, or is still under way ({} is there)", kJournalFile));
    return run;
  }
  ASSIGN_OR_RETURN(run.data, LoadRun(folder, sealing));
  ASSIGN_OR_RETURN(run.scenarios, LoadScenarios(folder / "manifest.json"));
  RETURN_IF_ERROR(CheckRows(run, {(folder / "cells.jsonl").string(), 0, 0}));
  if (run.data.cpu_seconds.empty() && std::any_of(run.scenarios.begin(), run.scenarios.end(), WantsTimes)) {
    return Fail({(folder / "timings.jsonl").string(), 0, 0}, "tells no times, which a gate of this run needs");
  }
  return run;
}

}  // namespace etude
