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

/// The version of the layout of a result folder (docs/results.md), raised when old readers would fail.
constexpr int kResultSchema = 3;

/// Rows and their times, as lines of text.
constexpr const char *kCellsFile = "cells.jsonl", *kTimingsFile = "timings.jsonl";
/// Stands in a result folder while its run is under way, and after it was interrupted.
constexpr const char* kJournalFile = "journal.jsonl";
/// The file is there only where libraries changed while a run was made and somebody accepted that; it tells them, then
/// and now.
constexpr const char* kOtherLibrariesFile = "other_libraries.json";

/// Runs of more cells than this keep them as columns (column_writer.h) instead of lines of text.
constexpr std::size_t kMaxRowsAsText = 100'000;
/// The number of rows, about, that LoadRun holds of such runs.
constexpr std::size_t kMaxRowsHeld = 20'000;

/// Writes cells, series, recordings, times and summary of a whole run, row by row; all but the times are the same bytes
/// for any number of workers.
class ResultWriter {
 public:
  /// Begins a folder for rows of these studies. Without studies it is one for few rows.
  static Result<ResultWriter> Begin(const std::filesystem::path& folder, std::span<const Study> studies = {},
                                    std::size_t most_as_text = kMaxRowsAsText);

  /// The next row, in canonical order.
  Result<void> Add(const Row& row, const CellUsage& usage);
  /// Ends the writing: what stands in the folder then is all there is.
  Result<void> Finish(const std::vector<ScenarioSummary>& scenarios);

 private:
  explicit ResultWriter(std::filesystem::path folder) : folder_(std::move(folder)) {}
  Result<void> BeginScenario(const std::string& scenario);
  Result<void> FinishScenario();
  Result<void> AddAsText(const Row& row, const CellUsage& usage);

  std::filesystem::path folder_;
  std::optional<AtomicFile> cells_, timings_;  ///< of rows as text
  std::vector<Study> studies_;                 ///< of rows as columns
  std::string scenario_;                       ///< whose rows come now
  std::optional<AtomicFile> series_;
  std::optional<ColumnWriter> columns_;
};

/// The way in which a reader treats a folder whose seal does not hold (seal.h).
enum class Sealing {
  kRequired,  ///< refuses it
  kIgnored,   ///< reads it, and says so in `RunData::unsealed`
};

/// Reads a result folder. Fails with file:line when a file is missing, torn or of another schema
/// version, when the run did not come to its end, when its seal does not hold, and when another run took its place
/// meanwhile (CheckStillThere).
Result<RunData> LoadRun(const std::filesystem::path& folder, Sealing sealing = Sealing::kRequired);

/// A result folder without its rows, series and recordings.
Result<RunData> LoadRunOutline(const std::filesystem::path& folder, Sealing sealing = Sealing::kRequired);

/// Fails when another run has taken the folder's place since `run` was loaded from it.
Result<void> CheckStillThere(const std::filesystem::path& folder, const RunData& run);

/// A folder as it stood when a reader began.
class FolderBegun {
 public:
  explicit FolderBegun(const std::filesystem::path& folder);
  /// Gives what was read; of a failure to read, when another folder stands there by now, says that instead.
  template <typename Value>
  Result<Value> Tell(Result<Value> read) const {
    if (read || IsThere()) return read;
    return WasReplaced();
  }

 private:
  bool IsThere() const;
  tl::unexpected<Error> WasReplaced() const;

  std::filesystem::path folder_;
  std::pair<std::uint64_t, std::uint64_t> number_;  ///< of its device, and there
};

/// The file that keeps the recording of a cell (Row::Id), where there is one.
FilePath RecordingFile(const std::filesystem::path& folder, const std::string& cell);

/// Writes every row of a result folder as a line of cells.jsonl, whether or not the folder holds them so.
Result<void> WriteRows(const std::filesystem::path& folder, Sealing sealing,
                       const std::function<Result<void>(std::string_view line)>& write);

/// True if the rows are those that summary.json sums up: as many of each scenario, none twice.
Result<void> CheckRowsAgainstSummary(const std::filesystem::path& folder, const RunData& run);

}  // namespace etude
