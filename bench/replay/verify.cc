#include "bench/replay/verify.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <span>
#include <utility>

#include "bench/finished_runs/finished_runs.h"
#include "bench/replay/verify_manifest.h"
#include "bench/results/columns.h"
#include "bench/results/row_json.h"
#include "bench/results/seal.h"
#include "bench/results/summary_json.h"
#include "bench/run/manifest.h"
#include "bench/run/outside_metrics.h"
#include "bench/run/parallel_summary.h"
#include "bench/run/supervisor.h"
#include "bench/statistics/scenario_table.h"
#include "engine/base/machine.h"
#include "io/files/files.h"
#include "io/files/json_text.h"
#include "io/files/temporary_folder.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Computes the summary of a run from its rows. The rows are read once, not once for each scenario.
Result<Json> SummaryOf(const FinishedRun& run, int jobs) {
  std::vector<ScenarioTable> tables;
  for (const FinishedScenario& scenario : run.scenarios) tables.emplace_back(scenario.study);
  ForEachRow(run.data, [&](const Row& row, std::size_t) {
    for (ScenarioTable& table : tables) table.Add(row);
  });
  std::vector<ScenarioSummary> summaries;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const FinishedScenario& scenario = run.scenarios[i];
    ASSIGN_OR_RETURN(auto summary, SummariseInParallel(scenario.study, tables[i], scenario.seed, jobs));
    summaries.push_back(std::move(summary));
  }
  return EncodeSummaries(summaries);
}

Result<Verified> VerifySummary(const FilePath& folder, const FinishedRun& run, int jobs) {
  Verified verified{fmt::format("summary.json: equal to a summary computed again from {} rows", CountRows(run.data)),
                    {}};
  ASSIGN_OR_RETURN(const auto then, ReadJsonFile(folder / "summary.json"));
  ASSIGN_OR_RETURN(const auto now, SummaryOf(run, jobs));
  ASSIGN_OR_RETURN(const auto text, WriteJson(now));
  ASSIGN_OR_RETURN(const auto found, ReadWholeFile(folder / "summary.json"));
  if (found == text + "\n") return verified;
  // Numbers are written without rounding, so comparing the parsed values is exact.
  ASSIGN_OR_RETURN(const auto again, ReadJson(text, "the summary computed again"));
  const auto differences = CompareManifests(then, again);
  verified.differences = {differences.empty() ? "differs from the text that a run writes" : InWords(differences)};
  if (!differences.empty()) {
    verified.differences[0] +=
        "; if only intervals and p-values differ, another version of Etude may have drawn other random numbers "
        "(repeat the run to compare)";
  }
  return verified;
}

/// Returns the files that a run of these scenarios may leave, relative to its folder. Files that other commands make
/// from the results (reports, videos) are not included.
Result<std::set<fs::path>> FilesOfRun(const FilePath& folder, const FinishedRun& run) {
  // Add the files that every run may leave.
  std::set<fs::path> files = {"manifest.json", "host.json", "summary.json", kOtherLibrariesFile,
                              kSealFile,       kSignedFile, kSignatureFile, kLockFile};
  ASSIGN_OR_RETURN(const auto scenarios, ScenariosOf(folder));
  const bool has_columns = Exists(folder / kColumnsFolder);
  if (!has_columns) files.insert({kCellsFile, kTimingsFile});
  for (const Scenario& scenario : scenarios) {
    if (has_columns) {
      ASSIGN_OR_RETURN(const auto index, ReadColumnIndex(folder / kColumnsFolder / scenario.name));
      files.merge(FilesOfColumns(index));
    } else {
      files.insert(fs::path("series") / (scenario.name + ".jsonl"));
    }
    for (const ScenarioProgram& program : ProgramsIn(scenario)) {
      files.insert(ErrorFileOf("stderr", scenario, program));
    }
  }
  // Add the recordings of the cells that keep their motions.
  std::map<std::string, const RecordingSelection*> recorded;
  for (const Scenario& scenario : scenarios) recorded[scenario.name] = &scenario.recordings;
  if (!Exists(folder / "recordings")) return files;
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
  Verified verified{"files: only files that a run of this manifest writes", {}};
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder.given(), error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path name = entry->path().lexically_relative(folder.given());
    if (IsMadeFromResults(name.string())) {
      entry.disable_recursion_pending();
    } else if (!fs::is_directory(entry->symlink_status(error)) && !allowed.contains(name)) {
      verified.differences.push_back(name.generic_string() + " does not belong to a run of this manifest");
    }
  }
  if (error) return Fail({folder.string()}, "cannot be read: {}", error.message());
  std::ranges::sort(verified.differences);
  return verified;
}

Verified VerifyRows(const FinishedRun& run) {
  Verified verified{"rows: exactly the rows of the manifest, in its order", run.incomplete};
  if (!run.incomplete.empty()) return verified;
  std::vector<std::string> wanted;
  for (const FinishedScenario& scenario : run.scenarios)
    std::ranges::move(CellsOf(scenario.study), std::back_inserter(wanted));
  ForEachRow(run.data, [&](const Row& row, std::size_t place) {
    if (!verified.differences.empty() || row.Id() == wanted[place]) return;
    verified.differences = {fmt::format("row {} is {}; expected {}", place + 1, row.Id(), wanted[place])};
  });
  return verified;
}

/// Compares the lines of a file with the lines that a run would write. `line_of` returns the expected text for a line.
Result<void> CompareLines(const FilePath& file, const std::function<Result<std::string>(std::string_view)>& line_of,
                          Verified& verified) {
  bool differs = false;
  return ForEachLine(file, [&](std::string_view line, const Place& place) -> Result<void> {
    ASSIGN_OR_RETURN(const auto wanted, line_of(line));
    if (!differs && line != wanted)
      verified.differences.push_back(ToString(place) + " differs from the text that a run writes");
    differs = differs || line != wanted;
    return {};
  });
}

/// Compares the lines of timings.jsonl with the cells. Times and memory are not compared, because no run repeats them.
Result<void> CompareTimings(const FilePath& file, std::span<const std::string> cells, Verified& verified) {
  std::size_t row = 0;
  const auto line_of = [&](std::string_view line) -> Result<std::string> {
    if (row == cells.size()) return std::string();
    ASSIGN_OR_RETURN(const auto json, ReadJson(std::string(line), file.string()));
    CellUsage usage;
    for (const auto& [key, number] : {std::pair{"wall_s", &usage.wall_s},
                                      {"cpu_s", &usage.cpu_s},
                                      {"peak_mb", &usage.peak_mb},
                                      {"world_wall_s", &usage.world_wall_s},
                                      {"world_cpu_s", &usage.world_cpu_s}}) {
      if (json.contains(key) && json.at(key).is_number()) *number = json.at(key).get<double>();
    }
    return WriteJson(EncodeUsage(cells[row++], usage));
  };
  RETURN_IF_ERROR(CompareLines(file, line_of, verified));
  if (row < cells.size()) verified.differences.push_back(fmt::format("{} ends after {} lines", file.string(), row));
  return {};
}

/// Checks the text files for content that this program ignores but other programs may use: duplicate keys, and
/// additional rows or curves.
Result<Verified> VerifyText(const FilePath& folder, const FinishedRun& run) {
  Verified verified{"texts: only lines and keys that this program reads", {}};
  // Keys must not occur twice.
  const bool has_columns = Exists(folder / kColumnsFolder);
  std::vector<FilePath> files = {folder / "manifest.json", folder / "host.json"};
  for (const FinishedScenario& scenario : run.scenarios) {
    if (has_columns) files.push_back(folder / kColumnsFolder / scenario.study.scenario / kIndexFile);
  }
  for (const FilePath& file : files) {
    ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
    // Readers differ in which of two equal keys they use.
    if (const auto key = ParseJsonText(text).repeated_key)
      verified.differences.push_back(fmt::format("{}: '{}' appears twice", file.string(), *key));
  }
  if (has_columns) return verified;
  // Every line of the rows, then of the curves, must be as a run writes it.
  std::vector<std::string> cells;
  const std::size_t rows = CountRows(run.data);
  RETURN_IF_ERROR(CompareLines(
      folder / kCellsFile,
      [&](std::string_view) -> Result<std::string> {
        if (cells.size() == rows) return std::string();
        const Row row = RowAt(run.data, cells.size());
        cells.push_back(row.Id());
        return WriteJson(EncodeRow(row));
      },
      verified));
  RETURN_IF_ERROR(CompareTimings(folder / kTimingsFile, cells, verified));
  std::size_t of_row = 0;
  for (const FinishedScenario& scenario : run.scenarios) {
    const FilePath file = folder / "series" / (scenario.study.scenario + ".jsonl");
    if (!Exists(file)) continue;
    RETURN_IF_ERROR(CompareLines(
        file,
        [&](std::string_view) -> Result<std::string> {
          // Expect the curves of the next row that has curves. A line of another row, or a duplicate line, does not
          // contain these curves and is reported.
          std::vector<Series> series;
          while (of_row < cells.size() && (series = run.data.source->SeriesOf(of_row)).empty()) ++of_row;
          if (of_row == cells.size()) return std::string();
          return WriteJson(EncodeSeriesLine(cells[of_row++], series));
        },
        verified));
  }
  return verified;
}

Result<bool> AreSame(const FilePath& a, const FilePath& b) {
  constexpr std::size_t kChunk = 1 << 20;
  ASSIGN_OR_RETURN(const auto first, OpenFile(a, O_RDONLY));
  ASSIGN_OR_RETURN(const auto second, OpenFile(b, O_RDONLY));
  std::string one(kChunk, 0), other(kChunk, 0);
  const auto read = [](const Descriptor& file, const FilePath& path, std::string& into) -> Result<std::size_t> {
    std::size_t filled = 0;
    while (filled < into.size()) {
      const ssize_t count = ::read(file.number(), into.data() + filled, into.size() - filled);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return CannotRead(path.string(), "cannot read this file", errno);
      if (count == 0) break;
      filled += static_cast<std::size_t>(count);
    }
    return filled;
  };
  while (true) {
    ASSIGN_OR_RETURN(const auto of_one, read(first, a, one));
    ASSIGN_OR_RETURN(const auto of_other, read(second, b, other));
    if (std::string_view(one).substr(0, of_one) != std::string_view(other).substr(0, of_other)) return false;
    if (of_one < kChunk) return true;
  }
}

/// Writes the columns again from the rows and compares the bytes. Without this check, a column could contain numbers
/// that belong to no row, and other programs that read the column would use them.
Result<Verified> VerifyColumns(const FilePath& folder, const FinishedRun& run) {
  Verified verified{"columns: equal to columns made again from the rows, byte for byte", {}};
  std::size_t place = 0;
  for (const FinishedScenario& scenario : run.scenarios) {
    ASSIGN_OR_RETURN(const auto again, TemporaryFolder::Make("verify"));
    ColumnWriter writer(again.path(), scenario.study);
    const std::size_t end = place + CellsOf(scenario.study).size();
    for (Row row; place < end; ++place) {
      run.data.source->Read(place, row);
      row.result.series = run.data.source->SeriesOf(place);
      RETURN_IF_ERROR(writer.Add(row, {}));
    }
    RETURN_IF_ERROR(writer.Finish());
    ASSIGN_OR_RETURN(const auto index, ReadColumnIndex(folder / kColumnsFolder / scenario.study.scenario));
    for (const fs::path& name : FilesOfColumns(index)) {
      if (*name.begin() != kColumnsFolder || !Exists(folder / name)) continue;
      const bool is_made = fs::exists(again.path() / name);
      ASSIGN_OR_RETURN(const bool same, is_made ? AreSame(folder / name, again.path() / name) : Result<bool>(false));
      if (!same) verified.differences.push_back(name.generic_string() + " contains data that belong to no row");
    }
  }
  return verified;
}

Verified VerifyWorlds(const FinishedRun& run, const Plan& plan) {
  Verified verified{"worlds: every row has the clips and units that the random numbers select", {}};
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
  Verified verified{fmt::format("{} of {} cells, and {} cells with a recording, run again: {}", choice.drawn,
                                choice.drawable, choice.recorded, "stages, metrics, curves, recordings"),
                    {}};
  for (const CellCheck& check : replayed.checks) {
    if (check.same) continue;
    const bool is_of_machine = check.stage == "status" && (IsOfMachine(check.then) || IsOfMachine(check.now));
    verified.differences.push_back(fmt::format(
        "{}: {} was {} and is {}{}", check.cell, check.stage, check.then, check.now,
        is_of_machine ? "; either the machines differ, or the run was forged; this check cannot distinguish the two"
                      : ""));
  }
  return verified;
}

Result<VerifyOutcome> VerifyFolder(const ReplayOptions& options, bool replays) {
  const FilePath folder = Inside(options.folder);
  ASSIGN_OR_RETURN(const auto run, LoadFinishedRun(options.folder, Sealing::kIgnored, LoadedPart::kOutline));
  // Check the rows first, because all other checks rely on them.
  VerifyOutcome outcome;
  std::vector<Verified>& all = outcome.checks;
  all.push_back({"seal.json: every file is unchanged since it was sealed", {}});
  if (!run.data.unsealed.empty()) all.back().differences.push_back(run.data.unsealed);
  all.push_back(VerifyRows(run));
  if (!all.back().differences.empty()) return outcome;
  ASSIGN_OR_RETURN(all.emplace_back(), VerifyFiles(folder, run));
  ASSIGN_OR_RETURN(all.emplace_back(), VerifyText(folder, run));
  ASSIGN_OR_RETURN(all.emplace_back(), VerifyHost(folder));
  if (Exists(folder / kColumnsFolder)) {
    ASSIGN_OR_RETURN(all.emplace_back(), VerifyColumns(folder, run));
  }
  ASSIGN_OR_RETURN(all.emplace_back(), VerifySummary(folder, run, WorkerCount(options.jobs)));
  // Check the manifest. With `replays`, also check the worlds and run the chosen cells again.
  if (!replays) {
    ASSIGN_OR_RETURN(const auto suite, ReadManifest(folder / "manifest.json"));
    ASSIGN_OR_RETURN(all.emplace_back(), VerifyManifest(folder, run, suite, {}, Json()));
    return outcome;
  }
  ASSIGN_OR_RETURN(const auto prepared, PrepareRun(folder / "manifest.json", options.key));
  Json programs;
  if (!options.without_programs) {
    RETURN_IF_ERROR(CheckPrograms(options.folder, prepared.scenarios, options.outside));
    ASSIGN_OR_RETURN(const Fence fence, FenceFor(prepared.scenarios, options.outside, options.folder, options.key));
    RETURN_IF_ERROR(AddPrograms(prepared.scenarios, fence, programs));
  }
  ASSIGN_OR_RETURN(all.emplace_back(), VerifyManifest(folder, run, prepared.suite, prepared.scenarios, programs));
  all.push_back(VerifyWorlds(run, Plan(prepared.scenarios)));
  ASSIGN_OR_RETURN(auto replayed, ReplayPrepared(options, run.data, prepared));
  all.push_back(VerifyCells(replayed));
  outcome.choice = std::move(replayed.choice);
  return outcome;
}

}  // namespace

Result<VerifyOutcome> VerifyRun(const ReplayOptions& options, bool replays) {
  const FolderBegun begun(options.folder);
  return begun.Tell(VerifyFolder(options, replays));
}

}  // namespace etude
