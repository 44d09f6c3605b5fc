#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/model/study.h"
#include "bench/results/columns.h"
#include "io/files/files.h"
#include "io/files/json.h"

namespace etude {

/// The version of the layout of a result folder (docs/results.md). The version is raised when older programs can no
/// longer read the folder.
constexpr int kResultSchema = 4;

/// The names of the files with the rows and with the times of the cells, one line of text per row.
constexpr const char *kCellsFile = "cells.jsonl", *kTimingsFile = "timings.jsonl";
/// The name of a file that exists in a result folder while its run is in progress, and after an interruption.
constexpr const char* kJournalFile = "journal.jsonl";
/// The name of a file that lists changed libraries. It exists only if a run was resumed or merged although libraries
/// had changed.
constexpr const char* kOtherLibrariesFile = "other_libraries.json";

/// The largest number of cells that a run stores as lines of text. Runs with more cells store them as columns
/// (columns.h).
constexpr std::size_t kMaxRowsAsText = 100'000;
/// The approximate number of rows that LoadRun loads if the run is stored as columns.
constexpr std::size_t kMaxRowsHeld = 20'000;

/// Writes a run's results row by row. All files except the times have the same bytes for any number of workers.
class ResultWriter {
 public:
  /// Begins a result folder for the rows of these studies. If there are more than `most_as_text` rows, they are stored
  /// as columns.
  static Result<ResultWriter> Begin(const std::filesystem::path& folder, std::span<const Study> studies = {},
                                    std::size_t most_as_text = kMaxRowsAsText);

  /// Adds the next row, in canonical order.
  Result<void> Add(const Row& row, const CellUsage& usage);
  /// Writes the summary and closes all files.
  Result<void> Finish(const std::vector<ScenarioSummary>& scenarios);

 private:
  explicit ResultWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}
  Result<void> BeginScenario(const std::string& scenario);
  Result<void> FinishScenario();
  Result<void> AddAsText(const Row& row, const CellUsage& usage);

  std::filesystem::path folder_;
  std::optional<AtomicFile> cells_, timings_;  ///< used if rows are stored as text
  std::vector<Study> studies_;                 ///< used if rows are stored as columns
  std::string scenario_;                       ///< the scenario of the current rows
  std::optional<AtomicFile> series_;
  std::optional<ColumnWriter> columns_;
};

/// The action of a reader if a folder's seal is broken (seal.h).
enum class Sealing {
  kRequired,  ///< the reader fails
  kIgnored,   ///< the folder is read, and `RunData::unsealed` is set
};

/// Reads a result folder. Fails, with file and line if possible, if a file is missing, incomplete or of another schema,
/// if the run has not ended, if the seal is broken, or if another run replaced the folder during reading
/// (CheckStillThere).
Result<RunData> LoadRun(const std::filesystem::path& folder, Sealing sealing = Sealing::kRequired);

/// Reads a result folder without its recordings. Rows and curves are not held in memory: `RunData::source` reads them
/// one by one.
Result<RunData> LoadRunRowByRow(const std::filesystem::path& folder, Sealing sealing = Sealing::kRequired);

/// Reads everything except rows, series, recordings and times. If the rows are stored as columns, `RunData::source`
/// reads them.
Result<RunData> LoadRunOutline(const std::filesystem::path& folder, Sealing sealing = Sealing::kRequired);

/// Returns "is shard 1/2 of a run; …" if the folder holds an unmerged shard of a run, and "" if not.
std::string ShardInWords(const std::filesystem::path& folder);

/// Fails if another run has replaced the folder since `run` was loaded.
Result<void> CheckStillThere(const std::filesystem::path& folder, const RunData& run);

/// Detects if a folder is replaced while it is read.
class FolderBegun {
 public:
  explicit FolderBegun(const std::filesystem::path& folder);
  /// Returns `read`, the result of reading the folder. If reading failed and the folder was replaced meanwhile,
  /// returns an error that says so.
  template <typename Value>
  Result<Value> Tell(Result<Value> read) const {
    if (read || IsThere()) return read;
    return WasReplaced();
  }

 private:
  bool IsThere() const;
  tl::unexpected<Error> WasReplaced() const;

  std::filesystem::path folder_;
  std::pair<std::uint64_t, std::uint64_t> number_;  ///< device and inode of the folder
};

/// Returns the path of the recording of a cell (Row::Id), whether or not it exists.
FilePath RecordingFile(const std::filesystem::path& folder, const std::string& cell);

/// Passes every row of a result folder to `write`, as a line of cells.jsonl. Columns are converted.
Result<void> WriteRows(const std::filesystem::path& folder, Sealing sealing,
                       const std::function<Result<void>(std::string_view line)>& write);

/// Fails unless the rows are those that summary.json summarises: the same number per scenario, and no duplicate row.
Result<void> CheckRowsAgainstSummary(const std::filesystem::path& folder, const RunData& run);

}  // namespace etude
