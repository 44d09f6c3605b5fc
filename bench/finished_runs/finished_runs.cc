#include "bench/finished_runs/finished_runs.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "bench/metrics/catalogue.h"
#include "bench/run/cell_runner.h"
#include "bench/run/outside_programs.h"
#include "bench/scenario/study_of.h"
#include "bench/tasks/registry.h"
#include "engine/base/digest.h"
#include "engine/base/machine.h"
#include "io/files/json.h"

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

/// Returns the digest of everything that determines the worlds of a condition: the task, the task's own keys and the
/// clips. The files that a task judges are left out, because they have digests of their own.
std::string WorldDigest(const std::string& task, const Node& condition, std::span<const std::string> clip_digests) {
  Digest digest;
  digest.Add(std::string_view(task));
  const std::vector<std::string>& of_files = FindTaskKind(task)->keys_of_files;
  std::vector<const Node::Entry*> own;
  for (const Node::Entry& entry : condition.entries) {
    const bool is_of_files = std::ranges::find(of_files, entry.key) != of_files.end();
    if (!IsCommonKey(entry.key) && !is_of_files) own.push_back(&entry);
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

constexpr const char* kBuiltInName = "built in";

// A fast scenario with metrics of every kind: medians, a share and a count. Each method but the first limits, by an
// angle of its own, how far a joint may turn from the start pose. The start pose has an error of 5° or 15° (standard
// deviation), so some methods differ little from the first one and others much.
constexpr const char* kBuiltInScenario = R"(
scenario: gate-self-test
question: Does the gate see what it should, and nothing else?
task: ik
trials: 30
sweep: {joint_noise_deg: [5, 15]}
max_sweeps: 60
methods:
  - {name: reference,     solver: damped-least-squares}
  - {name: within-40-deg, solver: damped-least-squares, tolerance_deg: 40}
  - {name: within-36-deg, solver: damped-least-squares, tolerance_deg: 36}
  - {name: within-30-deg, solver: damped-least-squares, tolerance_deg: 30}
metrics: [orientation_error_deg, position_error_cm, hidden_angle_error_deg, solved_practical, iterations]
)";

namespace fs = std::filesystem;

/// Fails if a version of a metric differs from this program's version, because values of two versions must not be
/// mixed.
Result<void> CheckMetricVersions(const Json& manifest, const Place& place) {
  const Json versions = manifest.value("metrics", Json::object());
  for (const auto& [id, version] : versions.items()) {
    const MetricInfo* metric = FindMetric(id);
    if (metric != nullptr && version != metric->version) {
      return Fail(place, "contains values of version {} of {}, but this program measures version {}; repeat the run",
                  version.dump(), id, metric->version);
    }
  }
  return {};
}

/// Returns the name of each world made of files and the digest of its truth; the digest is "" if it has no truth.
/// `digests` are the manifest's digests of files: for each world, in order, first the truth, if there is one, then all
/// answers.
Result<NamedDigests> TruthsOf(const ScenarioSetup& setup, std::span<const std::string> digests, const Place& place) {
  NamedDigests truths;
  std::size_t at = 0;
  for (const JudgedFiles& world : setup.files) {
    const bool has_truth = !world.truth.empty();
    if (at >= digests.size()) return Fail(place, "is not a complete manifest: digests of files are missing");
    truths.emplace_back(world.name, has_truth ? digests[at] : "");
    at += (has_truth ? 1 : 0) + world.answers.size() - static_cast<std::size_t>(std::ranges::count(world.answers, ""));
  }
  return truths;
}

/// Reads the scenarios of a manifest.json from the scenario texts that it contains.
Result<std::vector<FinishedScenario>> LoadScenarios(const FilePath& path) {
  ASSIGN_OR_RETURN(const auto manifest, ReadJsonFile(path));
  const Place place{path.string(), 0, 0};
  ASSIGN_OR_RETURN(const auto suite, DecodeSetup(manifest, place));
  RETURN_IF_ERROR(CheckMetricVersions(manifest, place));
  // Parse each scenario. The manifest contains the digests of the scenario's clips.
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
    if (setup.files.empty()) {
      finished.push_back(FinishScenario(scenario, setup, clip_digests));
    } else {
      ASSIGN_OR_RETURN(auto files, TruthsOf(setup, clip_digests, place));
      finished.push_back(FinishScenario(scenario, setup, {}));
      finished.back().files = std::move(files);
    }
    // Worlds of a secret seed also depend on the version of the rule that makes secret worlds.
    if (setup.seed.IsPlain()) continue;
    for (auto& [condition, digest] : finished.back().worlds) {
      digest = Digest().Add(digest).Add(std::int64_t{suite.secret_worlds}).Hex();
    }
  }
  return finished;
}

bool WantsTimes(const FinishedScenario& scenario) { return !scenario.study.gate.time_ratios.empty(); }

}  // namespace

FinishedScenario FinishScenario(const Scenario& scenario, const ScenarioSetup& setup,
                                std::span<const std::string> clip_digests) {
  FinishedScenario finished{.study = StudyOf(scenario), .seed = setup.seed.Public(), .worlds = {}, .methods = {}};
  finished.study.unit = SampledUnit(scenario, setup);
  for (const Condition& condition : scenario.conditions) {
    finished.worlds.emplace_back(CompactLabel(condition.swept),
                                 WorldDigest(scenario.task, condition.node, clip_digests));
  }
  for (const MethodEntry& method : scenario.methods) finished.methods.emplace_back(method.name, MethodDigest(method));
  return finished;
}

Result<Rehearsal> ReadRehearsal(const std::string& file, std::optional<int> trials) {
  Rehearsal rehearsal;
  rehearsal.setup.file = file.empty() ? kBuiltInName : file;
  if (file.empty()) rehearsal.sources[kBuiltInName] = kBuiltInScenario;
  ASSIGN_OR_RETURN(auto scenarios, file.empty() ? ParseScenarios(kBuiltInName, rehearsal.sources)
                                                : ReadScenarios(file, rehearsal.sources));
  Scenario& scenario = scenarios.front();
  rehearsal.setup.name = scenario.name;
  rehearsal.setup.trials = trials.value_or(scenario.trials);
  rehearsal.setup.clips = scenario.clips;
  rehearsal.setup.libraries = scenario.libraries;
  scenario.trials = rehearsal.setup.trials;
  rehearsal.scenario = std::move(scenario);
  return rehearsal;
}

Result<FinishedRun> RunInProcess(const Rehearsal& rehearsal, std::uint64_t seed) {
  // Prepare the scenario under this seed.
  ScenarioSetup setup = rehearsal.setup;
  setup.seed = seed;
  ASSIGN_OR_RETURN(
      const auto prepared,
      Prepare(SuiteSetup{.suite = "", .seed = seed, .sources = rehearsal.sources, .scenarios = {}, .scored = {}}, setup,
              rehearsal.scenario));
  const Scenario& scenario = prepared.scenario();
  FinishedRun run;
  run.data.suite = scenario.name;
  run.data.seed = seed;
  run.scenarios.push_back(FinishScenario(scenario, setup, {}));
  // Run all cells, world by world.
  ASSIGN_OR_RETURN(const Fence fence, FenceFor({&prepared, 1}, {}, "", {}));
  CellRunner runner(prepared, "", fence);
  for (int condition = 0; condition < static_cast<int>(scenario.conditions.size()); ++condition) {
    for (int trial = 0; trial < scenario.trials; ++trial) {
      runner.Open(condition, trial);
      for (std::size_t m = 0; m < scenario.methods.size(); ++m) {
        FinishedCell cell = runner.Run(m);
        if (!cell.is_measured) cell = runner.Measure(condition, std::move(cell));
        if (!cell.why_not_run.empty()) return FailOfMachine("{}", cell.why_not_run);
        run.data.rows.push_back(std::move(cell.row));
      }
    }
  }
  return run;
}

namespace {

Result<FinishedRun> ReadFinishedRun(const fs::path& folder, Sealing sealing, LoadedPart part) {
  FinishedRun run;
  if (Exists(Inside(folder) / kJournalFile)) {
    if (const std::string shard = ShardInWords(folder); !shard.empty()) return Fail({folder.string()}, "{}", shard);
    run.incomplete.push_back(
        fmt::format("the run was interrupted or is still running, because the file {} exists", kJournalFile));
    return run;
  }
  const auto load = part == LoadedPart::kAll ? LoadRun : LoadRunRowByRow;
  ASSIGN_OR_RETURN(run.data, load(folder, sealing));
  ASSIGN_OR_RETURN(run.scenarios, LoadScenarios(Inside(folder) / "manifest.json"));
  RETURN_IF_ERROR(CheckStillThere(folder, run.data));
  RETURN_IF_ERROR(CheckRows(run, {(folder / "cells.jsonl").string(), 0, 0}));
  const bool has_times = CountRows(run.data) > 0 && CpuSecondsOf(run.data, RowAt(run.data, 0), 0).has_value();
  if (!has_times && std::any_of(run.scenarios.begin(), run.scenarios.end(), WantsTimes)) {
    return Fail({(folder / "timings.jsonl").string(), 0, 0},
                "contains no processor times, but a rule of the scenario's key 'gate' needs them");
  }
  return run;
}

}  // namespace

Result<FinishedRun> LoadFinishedRun(const fs::path& folder, Sealing sealing, LoadedPart part) {
  const FolderBegun begun(folder);
  return begun.Tell(ReadFinishedRun(folder, sealing, part));
}

}  // namespace etude
