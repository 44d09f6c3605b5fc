#include "bench/results/folder.h"

#include <sys/stat.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/metrics/export.h"
#include "bench/results/row_json.h"
#include "bench/results/seal.h"
#include "bench/results/summary_json.h"
#include "bench/results/text_rows.h"
#include "engine/base/digest.h"
#include "engine/base/named.h"
#include "sim/random/seed.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Returns a file name for a cell "scenario/condition/trial/method". A long name is shortened, with a digest to keep it
/// unique.
std::string FileNameOf(std::string cell) {
  constexpr std::size_t kMaxNameLength = 200;  // bytes; file systems allow 255, including the extension
  std::replace(cell.begin(), cell.end(), '/', '~');
  if (cell.size() > kMaxNameLength)
    cell = cell.substr(0, kMaxNameLength) + "~" + Digest().Add(std::string_view(cell)).Hex();
  return cell + ".json";
}

/// Calls `use(json, place)` for every line of a file. Stops at the first error.
template <typename Use>
Result<void> ForEachJson(const FilePath& path, Use use) {
  return ForEachLine(path, [&](std::string_view line, const Place& place) -> Result<void> {
    ASSIGN_OR_RETURN(const auto json, ReadJson(std::string(line), place.file, place.line));
    return use(json, place);
  });
}

Result<void> LoadSeries(const FilePath& folder, RunData& run) {
  for (const ScenarioSummary& scenario : run.scenarios) {
    const FilePath path = folder / "series" / (scenario.name + ".jsonl");
    if (!Exists(path)) continue;
    auto read = ForEachJson(path, [&](const Json& json, const Place& place) -> Result<void> {
      try {
        run.series.push_back({json.at("cell").get<std::string>(), DecodeSeries(json.at("series"))});
        return {};
      } catch (const Json::exception& error) {
        return Fail(place, "not a line of series: {}", error.what());
      }
    });
    if (!read) return read;
  }
  return {};
}

Result<void> LoadRecordings(const fs::path& folder, RunData& run) {
  for (const Row& row : run.rows) {
    const FilePath path = RecordingFile(folder, row.Id());
    if (!Exists(path)) continue;
    ASSIGN_OR_RETURN(const auto json, ReadJsonFile(path));
    ASSIGN_OR_RETURN(auto recording, DecodeRecording(json, {path.string(), 0, 0}));
    run.recordings.push_back({row.Id(), std::move(recording)});
  }
  return {};
}

Result<void> LoadTimes(const FilePath& folder, RunData& run) {
  const FilePath path = folder / kTimingsFile;
  if (!Exists(path)) return {};
  return ForEachJson(path, [&](const Json& json, const Place& place) -> Result<void> {
    try {
      run.cpu_seconds[json.at("cell").get<std::string>()] = json.at("cpu_s").get<double>();
      return {};
    } catch (const Json::exception& error) {
      return Fail(place, "not a line of times: {}", error.what());
    }
  });
}

RunSystem SystemOf(const Json& manifest) {
  RunSystem system{manifest.value("compiler", ""), manifest.value("glibc", ""), manifest.value("packages", ""), ""};
  const std::size_t ceres = system.ceres.find("Ceres ");
  system.ceres =
      ceres == std::string::npos ? "" : system.ceres.substr(ceres + 6, system.ceres.find(',', ceres) - ceres - 6);
  for (const Json& scenario : manifest.value("scenarios", Json::array())) {
    if (system.renderer.empty()) system.renderer = scenario.value("platform", "");
  }
  return system;
}

Result<void> LoadManifest(const FilePath& folder, RunData& run) {
  ASSIGN_OR_RETURN(const auto manifest, ReadJsonFile(folder / "manifest.json"));
  ASSIGN_OR_RETURN(const auto host, ReadJsonFile(folder / "host.json"));
  Place place{(folder / "manifest.json").string(), 0, 0};
  try {
    // Read the manifest: schema, metrics, seed, versions.
    const int schema = manifest.at("schema").get<int>();
    if (schema != kResultSchema) return Fail(place, "schema {}; this program reads {}", schema, kResultSchema);
    run.suite = manifest.at("suite").get<std::string>();
    RETURN_IF_ERROR(ReadAddedMetrics(manifest.value("own_metrics", Json::array()), place));
    const Json& seed = manifest.at("seed");
    ASSIGN_OR_RETURN(const Seed keyed,
                     seed.is_string() ? ParseSeed(seed.get<std::string>()) : Result<Seed>(seed.get<std::uint64_t>()));
    run.seed = keyed.Public();
    run.key_digest = keyed.Digest();
    run.program_version = manifest.at("etude").get<std::string>();
    run.system = SystemOf(manifest);
    // Read host.json. If any shard ran without a sandbox, the run counts as a run without one.
    place.file = (folder / "host.json").string();
    run.fence = host.value("fence", "");
    for (const Json& shard : host.value("shards", Json::array())) {
      if (const std::string fence = shard.value("fence", ""); run.fence.empty() || fence.starts_with("none")) {
        run.fence = fence;
      }
    }
    run.command_line = host.at("command_line").get<std::string>();
    run.host = host.at("host").get<std::string>();
    if (Exists(folder / kOtherLibrariesFile)) {
      run.host += fmt::format("; libraries changed meanwhile ({})", kOtherLibrariesFile);
    }
    run.wall_seconds = host.at("wall_seconds").get<double>();
  } catch (const Json::exception& error) {
    return Fail(place, "differs from what a run writes: {}", error.what());
  }
  return {};
}

/// Returns the text of the seal. The text differs between any two runs, because it contains digests of the times of a
/// run.
std::string SealText(const FilePath& folder) { return ReadWholeFile(folder / kSealFile).value_or(""); }

}  // namespace

std::string ShardInWords(const fs::path& folder) {
  const FilePath journal = Inside(folder) / kJournalFile;
  if (!Exists(journal)) return "";
  // The first line of a journal names the shard; "1/1" is a run without shards.
  auto lines = FileLines::Open(journal);
  std::string head;
  if (!lines || !lines->Next(head)) return "";
  const auto json = ReadJson(head, journal.string());
  if (!json || !json->is_object()) return "";
  const auto shard = json->find("shard");
  if (shard == json->end() || !shard->is_string() || *shard == "1/1") return "";
  return fmt::format("is shard {} of a run; 'etude merge DIR… -o DIR' makes one run of all its shards",
                     shard->get<std::string>());
}

FilePath RecordingFile(const fs::path& folder, const std::string& cell) {
  return Inside(folder) / "recordings" / FileNameOf(cell);
}

Result<ResultWriter> ResultWriter::Begin(const fs::path& folder, std::span<const Study> studies,
                                         std::size_t most_as_text) {
  ResultWriter writer(folder);
  std::size_t rows = 0;
  for (const Study& study : studies) {
    rows += study.conditions.size() * static_cast<std::size_t>(study.trials) * study.methods.size();
  }
  if (rows > most_as_text) {
    writer.studies_.assign(studies.begin(), studies.end());
    return writer;
  }
  ASSIGN_OR_RETURN(writer.cells_, AtomicFile::Begin(Inside(folder) / kCellsFile));
  if (!studies.empty()) {
    ASSIGN_OR_RETURN(writer.timings_, AtomicFile::Begin(Inside(folder) / kTimingsFile));
  }
  return writer;
}

Result<void> ResultWriter::BeginScenario(const std::string& scenario) {
  RETURN_IF_ERROR(FinishScenario());
  scenario_ = scenario;
  if (cells_) return {};
  const auto study = std::ranges::find(studies_, scenario, &Study::scenario);
  assert(study != studies_.end());
  columns_.emplace(folder_, *study);
  return {};
}

Result<void> ResultWriter::FinishScenario() {
  if (series_) RETURN_IF_ERROR(series_->Finish(OnDisk::kLater));
  series_.reset();
  if (columns_) RETURN_IF_ERROR(columns_->Finish());
  columns_.reset();
  return {};
}

Result<void> ResultWriter::Add(const Row& row, const CellUsage& usage) {
  if (row.scenario != scenario_) RETURN_IF_ERROR(BeginScenario(row.scenario));
  RETURN_IF_ERROR(columns_ ? columns_->Add(row, usage) : AddAsText(row, usage));
  if (!row.result.recording) return {};
  ASSIGN_OR_RETURN(const auto json, EncodeRecording(*row.result.recording));
  return SaveJson(RecordingFile(folder_, row.Id()), json, OnDisk::kLater);
}

Result<void> ResultWriter::AddAsText(const Row& row, const CellUsage& usage) {
  ASSIGN_OR_RETURN(const auto line, WriteJson(EncodeRow(row)));
  RETURN_IF_ERROR(cells_->Write(line + "\n"));
  if (timings_) {
    ASSIGN_OR_RETURN(const auto times, WriteJson(EncodeUsage(row.Id(), usage)));
    RETURN_IF_ERROR(timings_->Write(times + "\n"));
  }
  if (row.result.series.empty()) return {};
  if (!series_) {
    ASSIGN_OR_RETURN(series_, AtomicFile::Begin(Inside(folder_) / "series" / (scenario_ + ".jsonl")));
  }
  ASSIGN_OR_RETURN(const auto curves, WriteJson(EncodeSeriesLine(row.Id(), row.result.series)));
  return series_->Write(curves + "\n");
}

Result<void> ResultWriter::Finish(const std::vector<ScenarioSummary>& scenarios) {
  RETURN_IF_ERROR(FinishScenario());
  RETURN_IF_ERROR(SaveJson(Inside(folder_) / "summary.json", EncodeSummaries(scenarios), OnDisk::kLater));
  if (timings_) RETURN_IF_ERROR(timings_->Finish(OnDisk::kLater));
  return cells_ ? cells_->Finish(OnDisk::kLater) : Result<void>();
}

namespace {

std::pair<std::uint64_t, std::uint64_t> NumberOf(const fs::path& folder) {
  struct stat status {};
  if (::stat(folder.c_str(), &status) != 0) return {};
  return {status.st_dev, status.st_ino};
}

Result<RunData> ReadOutline(const fs::path& path, Sealing sealing) {
  RunData run;
  const FilePath folder = Inside(path);
  const Place place{path.string(), 0, 0};
  // Fail if the run has not finished.
  std::error_code error;
  if (!fs::is_directory(path, error)) return Fail(place, "no such folder; 'etude run' writes the folder of a run");
  if (Exists(folder / kJournalFile)) {
    if (const std::string shard = ShardInWords(path); !shard.empty()) return Fail(place, "{}", shard);
    return Fail(place,
                "this run was interrupted or is still running, because the file {} exists; 'etude run --resume' "
                "continues a run",
                kJournalFile);
  }
  if (!Exists(folder / "manifest.json")) {
    return Fail(place, "is not a run, because it contains no manifest.json; 'etude run' writes this file");
  }
  // Read the manifest, and check the seal over all files.
  run.seal = SealText(folder);
  RETURN_IF_ERROR(LoadManifest(folder, run));
  if (auto sealed = CheckSeal(path); !sealed) {
    if (sealing == Sealing::kRequired) {
      sealed.error().message += "; --unsealed reads the run anyway";
      return tl::unexpected(sealed.error());
    }
    run.unsealed = ToString(sealed.error());
  }
  // Read the summary and, if there are any, the columns.
  ASSIGN_OR_RETURN(const auto summary, ReadJsonFile(folder / "summary.json"));
  ASSIGN_OR_RETURN(run.scenarios, DecodeSummaries(summary, {(folder / "summary.json").string(), 0, 0}));
  if (Exists(folder / kColumnsFolder)) {
    ASSIGN_OR_RETURN(run.source, OpenColumns(path, NamesOf(run.scenarios)));
  }
  RETURN_IF_ERROR(CheckStillThere(path, run));
  return run;
}

}  // namespace

FolderBegun::FolderBegun(const fs::path& folder) : folder_(folder), number_(NumberOf(folder)) {}
bool FolderBegun::IsThere() const { return NumberOf(folder_) == number_; }
tl::unexpected<Error> FolderBegun::WasReplaced() const {
  return Fail({folder_.string()}, "was replaced by another run while etude read it");
}

Result<RunData> LoadRunOutline(const fs::path& path, Sealing sealing) {
  const FolderBegun begun(path);
  return begun.Tell(ReadOutline(path, sealing));
}

Result<void> CheckStillThere(const fs::path& folder, const RunData& run) {
  if (SealText(Inside(folder)) == run.seal) return {};
  return Fail({folder.string()}, "was replaced by another run while etude read it");
}

namespace {

Result<RunData> ReadRun(const fs::path& folder, Sealing sealing) {
  ASSIGN_OR_RETURN(auto run, LoadRunOutline(folder, sealing));
  if (run.source) {
    for (const std::size_t place : run.source->SampleRowIndices(kMaxRowsHeld)) {
      const Row& row = run.rows.emplace_back(RowAt(run, place));
      if (auto series = run.source->SeriesOf(place); !series.empty())
        run.series.push_back({row.Id(), std::move(series)});
      if (const auto cpu_s = run.source->CpuSecondsOf(place)) run.cpu_seconds[row.Id()] = *cpu_s;
    }
  } else {
    RETURN_IF_ERROR(ForEachJson(Inside(folder) / kCellsFile, [&](const Json& json, const Place& line) -> Result<void> {
      ASSIGN_OR_RETURN(auto row, DecodeRow(json, line));
      run.rows.push_back(std::move(row));
      return {};
    }));
    RETURN_IF_ERROR(LoadSeries(Inside(folder), run));
    RETURN_IF_ERROR(LoadTimes(Inside(folder), run));
  }
  RETURN_IF_ERROR(LoadRecordings(folder, run));
  RETURN_IF_ERROR(CheckStillThere(folder, run));
  return run;
}

Result<void> ReadRows(const fs::path& folder, Sealing sealing,
                      const std::function<Result<void>(std::string_view line)>& write) {
  ASSIGN_OR_RETURN(const auto run, LoadRunOutline(folder, sealing));
  if (!run.source) {
    RETURN_IF_ERROR(ForEachLine(Inside(folder) / kCellsFile,
                                [&](std::string_view line, const Place&) { return write(std::string(line) + "\n"); }));
    return CheckStillThere(folder, run);
  }
  Row row;
  for (std::size_t place = 0; place < run.source->size(); ++place) {
    run.source->Read(place, row);
    ASSIGN_OR_RETURN(const auto line, WriteJson(EncodeRow(row)));
    RETURN_IF_ERROR(write(line + "\n"));
  }
  return {};
}

}  // namespace

Result<RunData> LoadRun(const fs::path& folder, Sealing sealing) {
  const FolderBegun begun(folder);
  return begun.Tell(ReadRun(folder, sealing));
}

Result<RunData> LoadRunRowByRow(const fs::path& folder, Sealing sealing) {
  ASSIGN_OR_RETURN(auto run, LoadRunOutline(folder, sealing));
  if (!run.source) {
    ASSIGN_OR_RETURN(run.source, OpenTextRows(folder, NamesOf(run.scenarios)));
  }
  return run;
}

Result<void> WriteRows(const fs::path& folder, Sealing sealing,
                       const std::function<Result<void>(std::string_view line)>& write) {
  const FolderBegun begun(folder);
  return begun.Tell(ReadRows(folder, sealing, write));
}

Result<void> CheckRowsAgainstSummary(const fs::path& folder, const RunData& run) {
  const Place place{(folder / (run.source ? kColumnsFolder : kCellsFile)).string(), 0, 0};
  std::set<std::string> ids;
  for (const Row& row : run.rows) {
    if (!ids.insert(row.Id()).second) return Fail(place, "contains the cell {} twice", row.Id());
  }
  std::map<std::string, std::size_t> found;
  ForEachRow(run, [&](const Row& row, std::size_t) { ++found[row.scenario]; });
  for (const ScenarioSummary& scenario : run.scenarios) {
    std::size_t summed = 0;
    for (const ConditionSummary& condition : scenario.conditions) {
      for (const MethodSummary& method : condition.methods) {
        for (const auto& [status, count] : method.statuses) summed += static_cast<std::size_t>(count);
      }
    }
    if (found[scenario.name] != summed) {
      return Fail(place, "contains {} rows of scenario {}, but summary.json summarises {} rows", found[scenario.name],
                  scenario.name, summed);
    }
  }
  return {};
}

}  // namespace etude
