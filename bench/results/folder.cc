#include "bench/results/folder.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/files/files.h"
#include "bench/results/row_json.h"
#include "bench/results/seal.h"
#include "bench/results/summary_json.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// "scenario/condition/trial/method" as one file name; a long one is cut, and told apart by its digest.
std::string FileNameOf(std::string cell) {
  constexpr std::size_t kLongest = 200;  // file systems take 255 bytes, ending included
  std::replace(cell.begin(), cell.end(), '/', '~');
  if (cell.size() > kLongest) cell = cell.substr(0, kLongest) + "~" + Digest().Add(std::string_view(cell)).Hex();
  return cell + ".json";
}

Result<Json> ReadJsonFile(const fs::path& path) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(path));
  return ReadJson(text, path.string());
}

/// Calls `use(json, place)` for every line; stops at the first complaint.
template <typename Use>
Result<void> ForEachJson(const fs::path& path, Use use) {
  return ForEachLine(path, [&](std::string_view line, const Place& place) -> Result<void> {
    ASSIGN_OR_RETURN(const auto json, ReadJson(std::string(line), place.file, place.line));
    return use(json, place);
  });
}

Result<void> LoadSeries(const fs::path& folder, RunData& run) {
  for (const ScenarioSummary& scenario : run.scenarios) {
    const fs::path path = folder / "series" / (scenario.name + ".jsonl");
    if (std::error_code none; !fs::exists(path, none)) continue;
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
    const fs::path path = folder / "recordings" / FileNameOf(row.Id());
    if (std::error_code none; !fs::exists(path, none)) continue;
    ASSIGN_OR_RETURN(const auto json, ReadJsonFile(path));
    ASSIGN_OR_RETURN(auto recording, DecodeRecording(json, {path.string(), 0, 0}));
    run.recordings.push_back({row.Id(), std::move(recording)});
  }
  return {};
}

Result<void> LoadTimes(const fs::path& folder, RunData& run) {
  const fs::path path = folder / "timings.jsonl";
  if (std::error_code none; !fs::exists(path, none)) return {};
  return ForEachJson(path, [&](const Json& json, const Place& place) -> Result<void> {
    try {
      run.cpu_seconds[json.at("cell").get<std::string>()] = json.at("cpu_s").get<double>();
      return {};
    } catch (const Json::exception& error) {
      return Fail(place, "not a line of times: {}", error.what());
    }
  });
}

Result<void> LoadManifest(const fs::path& folder, RunData& run) {
  ASSIGN_OR_RETURN(const auto manifest, ReadJsonFile(folder / "manifest.json"));
  ASSIGN_OR_RETURN(const auto host, ReadJsonFile(folder / "host.json"));
  const Place place{(folder / "manifest.json").string(), 0, 0};
  try {
    const int schema = manifest.at("schema").get<int>();
    if (schema != kResultSchema) return Fail(place, "schema {}; this program reads {}", schema, kResultSchema);
    run.suite = manifest.at("suite").get<std::string>();
    run.seed = manifest.at("seed").get<std::uint64_t>();
    run.program_version = manifest.at("etude").get<std::string>();
    run.command_line = host.at("command_line").get<std::string>();
    run.host = host.at("host").get<std::string>();
    run.wall_seconds = host.at("wall_seconds").get<double>();
  } catch (const Json::exception& error) {
    return Fail(place, "not a manifest: {}", error.what());
  }
  return {};
}

}  // namespace

Result<ResultWriter> ResultWriter::Begin(const fs::path& folder) {
  ASSIGN_OR_RETURN(auto cells, AtomicFile::Begin(folder / "cells.jsonl"));
  return ResultWriter(folder, std::move(cells));
}

Result<void> ResultWriter::Add(const Row& row) {
  ASSIGN_OR_RETURN(const auto line, WriteJson(EncodeRow(row)));
  RETURN_IF_ERROR(cells_.Write(line + "\n"));
  if (row.scenario != scenario_) {
    if (series_) RETURN_IF_ERROR(series_->Finish());
    series_.reset();
    scenario_ = row.scenario;
  }
  if (!row.result.series.empty()) {
    if (!series_) {
      ASSIGN_OR_RETURN(series_, AtomicFile::Begin(folder_ / "series" / (scenario_ + ".jsonl")));
    }
    ASSIGN_OR_RETURN(const auto curves, WriteJson({{"cell", row.Id()}, {"series", EncodeSeries(row.result.series)}}));
    RETURN_IF_ERROR(series_->Write(curves + "\n"));
  }
  if (!row.result.recording) return {};
  ASSIGN_OR_RETURN(const auto json, EncodeRecording(*row.result.recording));
  ASSIGN_OR_RETURN(const auto text, WriteJson(json));
  return WriteFileAtomically(folder_ / "recordings" / FileNameOf(row.Id()), text + "\n");
}

Result<void> ResultWriter::Finish(const std::vector<ScenarioSummary>& scenarios) {
  if (series_) RETURN_IF_ERROR(series_->Finish());
  ASSIGN_OR_RETURN(const auto summary, WriteJson(EncodeSummaries(scenarios)));
  RETURN_IF_ERROR(WriteFileAtomically(folder_ / "summary.json", summary + "\n"));
  return cells_.Finish();
}

Result<void> SaveResults(const fs::path& folder, const std::vector<Row>& rows,
                         const std::vector<ScenarioSummary>& scenarios) {
  ASSIGN_OR_RETURN(auto writer, ResultWriter::Begin(folder));
  for (const Row& row : rows) RETURN_IF_ERROR(writer.Add(row));
  return writer.Finish(scenarios);
}

Result<RunData> LoadRun(const fs::path& folder, Sealing sealing) {
  RunData run;
  const Place place{folder.string(), 0, 0};
  std::error_code error;
  if (!fs::is_directory(folder, error)) return Fail(place, "no such folder; a run writes one (etude run)");
  if (fs::exists(folder / kJournalFile, error)) {
    return Fail(place,
                "this run did not come to its end, is still under way, or is a shard ({} is there); "
                "etude run --resume goes on with it, etude merge makes a run of shards",
                kJournalFile);
  }
  RETURN_IF_ERROR(LoadManifest(folder, run));
  if (auto sealed = CheckSeal(folder); !sealed) {
    if (sealing == Sealing::kRequired) {
      sealed.error().message += "; --unsealed reads the run all the same";
      return tl::unexpected(sealed.error());
    }
    run.unsealed = ToString(sealed.error());
  }
  RETURN_IF_ERROR(ForEachJson(folder / "cells.jsonl", [&](const Json& json, const Place& line) -> Result<void> {
    ASSIGN_OR_RETURN(auto row, DecodeRow(json, line));
    run.rows.push_back(std::move(row));
    return {};
  }));
  ASSIGN_OR_RETURN(const auto summary, ReadJsonFile(folder / "summary.json"));
  ASSIGN_OR_RETURN(auto scenarios, DecodeSummaries(summary, {(folder / "summary.json").string(), 0, 0}));
  run.scenarios = std::move(scenarios);
  RETURN_IF_ERROR(LoadSeries(folder, run));
  RETURN_IF_ERROR(LoadRecordings(folder, run));
  RETURN_IF_ERROR(LoadTimes(folder, run));
  return run;
}

Result<void> CheckRowsAgainstSummary(const fs::path& folder, const RunData& run) {
  const Place place{(folder / "cells.jsonl").string(), 0, 0};
  std::set<std::string> ids;
  for (const Row& row : run.rows) {
    if (!ids.insert(row.Id()).second) return Fail(place, "holds the cell {} twice", row.Id());
  }
  for (const ScenarioSummary& scenario : run.scenarios) {
    std::ptrdiff_t summed = 0;
    for (const ConditionSummary& condition : scenario.conditions) {
      for (const MethodSummary& method : condition.methods) {
        for (const auto& [status, count] : method.statuses) summed += count;
      }
    }
    const auto found =
        std::count_if(run.rows.begin(), run.rows.end(), [&](const Row& row) { return row.scenario == scenario.name; });
    if (found != summed) {
      return Fail(place, "holds {} rows of scenario {}; summary.json sums up {}", found, scenario.name, summed);
    }
  }
  return {};
}

}  // namespace etude
