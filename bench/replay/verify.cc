#include "bench/replay/verify.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "bench/finished_runs/finished_runs.h"
#include "bench/results/row_json.h"
#include "bench/results/seal.h"
#include "bench/results/summary_json.h"
#include "bench/run/manifest.h"
#include "bench/run/outside_metrics.h"
#include "bench/run/sum_up.h"
#include "bench/run/supervisor.h"
#include "bench/statistics/scenario_table.h"
#include "engine/base/names.h"
#include "io/files/files.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// The summary as the rows make it.
Result<Json> SummaryOf(const FinishedRun& run, int jobs) {
  std::vector<ScenarioSummary> summaries;
  for (const FinishedScenario& scenario : run.scenarios) {
    ScenarioTable table(scenario.study);
    ForEachRow(run.data, [&](const Row& row, std::size_t) { table.Add(row); });
    ASSIGN_OR_RETURN(auto summary, SumUp(scenario.study, table, scenario.seed, jobs));
    summaries.push_back(std::move(summary));
  }
  return EncodeSummaries(summaries);
}

Result<Verified> VerifySummary(const FilePath& folder, const FinishedRun& run, int jobs) {
  Verified verified{fmt::format("summary.json: computed again from {} rows", CountRows(run.data)), {}};
  ASSIGN_OR_RETURN(const auto then, ReadJsonFile(folder / "summary.json"));
  ASSIGN_OR_RETURN(const auto now, SummaryOf(run, jobs));
  ASSIGN_OR_RETURN(const auto text, WriteJson(now));
  ASSIGN_OR_RETURN(const auto found, ReadWholeFile(folder / "summary.json"));
  if (found == text + "\n") return verified;
  // What was written rounds nothing, so that it is compared as it reads.
  ASSIGN_OR_RETURN(const auto again, ReadJson(text, "the summary computed again"));
  const auto differences = CompareManifests(then, again);
  verified.differences = {differences.empty() ? "is written otherwise" : InWords(differences)};
  return verified;
}

/// The scenarios that a manifest describes, without their clips.
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

/// The files that a run of these scenarios may leave, from its folder, but for what is made from results.
Result<std::set<fs::path>> FilesOfRun(const FilePath& folder, const FinishedRun& run) {
  std::set<fs::path> files = {"manifest.json", "host.json", "summary.json", kOtherLibrariesFile,
                              kSealFile,       kSignedFile, kSignatureFile, kLockFile};
  ASSIGN_OR_RETURN(const auto scenarios, ScenariosOf(folder));
  if (!run.data.source) files.insert({kCellsFile, kTimingsFile});
  for (const Scenario& scenario : scenarios) {
    if (run.data.source) {
      ASSIGN_OR_RETURN(const auto index, ReadColumnIndex(folder / kColumnsFolder / scenario.name));
      files.merge(FilesOfColumns(index));
    } else {
      files.insert(fs::path("series") / (scenario.name + ".jsonl"));
    }
    for (const ScenarioProgram& program : ProgramsIn(scenario)) {
      const std::string role = std::string_view(program.role) == "metric" ? "metric~" : "";
      files.insert(ErrorFileOf("stderr", scenario, role + program.entry->name));
    }
  }
  std::map<std::string, const RecordingSelection*> recorded;
  for (const Scenario& scenario : scenarios) recorded[scenario.name] = &scenario.recordings;
  ForEachRow(run.data, [&](const Row& row, std::size_t) {
    const auto kept = recorded.find(row.scenario);
    if (kept == recorded.end() || !kept->second->KeepsTrial(row.trial) || !kept->second->KeepsMethod(row.method))
      return;
    files.insert(RecordingFile(folder.given(), row.Id()).below());
  });
  return files;
}

Result<Verified> VerifyFiles(const FilePath& folder, const FinishedRun& run) {
  ASSIGN_OR_RETURN(const auto allowed, FilesOfRun(folder, run));
  Verified verified{"files: those that such a run leaves", {}};
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder.given(), error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path name = entry->path().lexically_relative(folder.given());
    if (IsMadeFromResults(name.string())) {
      entry.disable_recursion_pending();
    } else if (!fs::is_directory(entry->symlink_status(error)) && !allowed.contains(name)) {
      verified.differences.push_back(name.generic_string() + " belongs to no run of this manifest");
    }
  }
  if (error) return Fail({folder.string()}, "cannot be read: {}", error.message());
  std::ranges::sort(verified.differences);
  return verified;
}

Verified VerifyRows(const FinishedRun& run) {
  Verified verified{"rows: those that the manifest asks for, in its order", run.incomplete};
  if (!run.incomplete.empty()) return verified;
  std::vector<std::string> wanted;
  for (const FinishedScenario& scenario : run.scenarios)
    std::ranges::move(CellsOf(scenario.study), std::back_inserter(wanted));
  ForEachRow(run.data, [&](const Row& row, std::size_t place) {
    if (!verified.differences.empty() || row.Id() == wanted[place]) return;
    verified.differences = {fmt::format("row {} is {}; there belongs {}", place + 1, row.Id(), wanted[place])};
  });
  return verified;
}

/// Finds a key that stands twice in one object: readers differ in which of the two they take.
std::optional<std::string> FindKeyTwice(const std::string& text) {
  std::vector<std::set<std::string>> open;
  std::optional<std::string> twice;
  std::ignore = Json::parse(
      text,
      [&](int, Json::parse_event_t event, Json& value) {
        if (event == Json::parse_event_t::object_start) open.emplace_back();
        if (event == Json::parse_event_t::object_end) open.pop_back();
        if (event != Json::parse_event_t::key) return true;
        const auto key = value.get<std::string>();
        if (!open.back().insert(key).second && !twice) twice = key;
        return true;
      },
      /*allow_exceptions=*/false);
  return twice;
}

/// Compares the lines of a file with those that a run would write. `line_of` gives the next one.
Result<void> CompareLines(const FilePath& file, const std::function<Result<std::string>()>& line_of,
                          Verified& verified) {
  bool differs = false;
  return ForEachLine(file, [&](std::string_view line, const Place& place) -> Result<void> {
    ASSIGN_OR_RETURN(const auto wanted, line_of());
    if (!differs && line != wanted) verified.differences.push_back(ToString(place) + " is written otherwise");
    differs = differs || line != wanted;
    return {};
  });
}

/// Compares the text files that other programs read, too, with what this program has read from them. Differences are
/// keys that stand twice, and rows or curves that this program did not read.
Result<Verified> VerifyText(const FilePath& folder, const FinishedRun& run) {
  Verified verified{"texts: nothing in them that this program has not read", {}};
  std::vector<FilePath> files = {folder / "manifest.json", folder / "host.json"};
  for (const FinishedScenario& scenario : run.scenarios) {
    if (run.data.source) files.push_back(folder / kColumnsFolder / scenario.study.scenario / kIndexFile);
  }
  for (const FilePath& file : files) {
    ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
    if (const auto key = FindKeyTwice(text))
      verified.differences.push_back(fmt::format("{}: '{}' stands there twice", file.string(), *key));
  }
  if (run.data.source) return verified;
  std::size_t row = 0, curves = 0;
  RETURN_IF_ERROR(CompareLines(
      folder / kCellsFile,
      [&]() -> Result<std::string> {
        return row < run.data.rows.size() ? WriteJson(EncodeRow(run.data.rows[row++])) : std::string();
      },
      verified));
  std::size_t of_row = 0;
  for (const FinishedScenario& scenario : run.scenarios) {
    const FilePath file = folder / "series" / (scenario.study.scenario + ".jsonl");
    if (!Exists(file)) continue;
    RETURN_IF_ERROR(CompareLines(
        file,
        [&]() -> Result<std::string> {
          if (curves == run.data.series.size()) return std::string();
          const CellSeries& of_cell = run.data.series[curves++];
          while (of_row < run.data.rows.size() && run.data.rows[of_row].Id() != of_cell.cell) ++of_row;
          if (of_row == run.data.rows.size()) return std::string();  // no row, or one that had its curves already
          ++of_row;
          return WriteJson(EncodeSeriesLine(of_cell.cell, of_cell.series));
        },
        verified));
  }
  return verified;
}

/// Compares what the dice choose for every row, run again or not.
Verified VerifyWorlds(const FinishedRun& run, const Plan& plan) {
  Verified verified{"worlds: every row is of the clips and units that the dice chose", {}};
  ForEachRow(run.data, [&](const Row& row, std::size_t place) {
    if (!verified.differences.empty()) return;
    const Row now = plan.IdentityOf(place);
    if (const CellCheck check = CompareIdentity(row, now); !check.same) {
      verified.differences = {fmt::format("{}: {} was {} and is {}", check.cell, check.stage, check.then, check.now)};
    }
  });
  return verified;
}

bool IsOfMachine(const std::string& status) {
  const auto found = FindStatus(status);
  return found && DependsOnMachine(*found);
}

Verified VerifyCells(const ReplayOutcome& replayed) {
  const CellChoice& choice = replayed.choice;
  Verified verified{fmt::format("{} of {} cells and {} that left a recording, run again: {}", choice.drawn,
                                choice.drawable, choice.recorded, "stages, metrics, curves, recordings"),
                    {}};
  for (const CellCheck& check : replayed.checks) {
    if (check.same) continue;
    const bool is_of_machine = check.stage == "status" && (IsOfMachine(check.then) || IsOfMachine(check.now));
    verified.differences.push_back(
        fmt::format("{}: {} was {} and is {}{}", check.cell, check.stage, check.then, check.now,
                    is_of_machine ? "; the machines differ, or it was forged: nobody can tell" : ""));
  }
  return verified;
}

}  // namespace

Result<VerifyOutcome> VerifyRun(const ReplayOptions& options, bool replays) {
  const FilePath folder = Inside(options.folder);
  ASSIGN_OR_RETURN(const auto run, LoadFinishedRun(options.folder, Sealing::kIgnored));
  VerifyOutcome outcome;
  std::vector<Verified>& all = outcome.checks;
  all.push_back({"seal.json: every file is as it was sealed", {}});
  if (!run.data.unsealed.empty()) all.back().differences.push_back(run.data.unsealed);
  all.push_back(VerifyRows(run));
  if (!all.back().differences.empty()) return outcome;
  ASSIGN_OR_RETURN(all.emplace_back(), VerifyFiles(folder, run));
  ASSIGN_OR_RETURN(all.emplace_back(), VerifyText(folder, run));
  ASSIGN_OR_RETURN(all.emplace_back(), VerifySummary(folder, run, WorkerCount(options.jobs)));
  if (!replays) return outcome;
  ASSIGN_OR_RETURN(const auto prepared, PrepareRun(folder / "manifest.json", options.key));
  all.push_back(VerifyWorlds(run, Plan(prepared.scenarios)));
  ASSIGN_OR_RETURN(auto replayed, ReplayPrepared(options, run.data, prepared));
  all.push_back(VerifyCells(replayed));
  outcome.choice = std::move(replayed.choice);
  return outcome;
}

}  // namespace etude
