#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/files/atomic_file.h"
#include "bench/files/json.h"
#include "bench/model/run_data.h"

namespace etude {

/// The version of the layout of a result folder (docs/results.md), raised when old readers would fail.
constexpr int kResultSchema = 3;

/// Stands in a result folder while its run is under way, and after it was interrupted.
constexpr const char* kJournalFile = "journal.jsonl";

/// Writes cells.jsonl, series/, recordings/ and summary.json of a whole run, row by row; these files are the same bytes
/// for any number of workers.
class ResultWriter {
 public:
  static Result<ResultWriter> Begin(const std::filesystem::path& folder);

  /// The next row, in canonical order.
  Result<void> Add(const Row& row);
  /// What stands in the folder then is all there is.
  Result<void> Finish(const std::vector<ScenarioSummary>& scenarios);

 private:
  ResultWriter(std::filesystem::path folder, AtomicFile cells) : folder_(std::move(folder)), cells_(std::move(cells)) {}

  std::filesystem::path folder_;
  AtomicFile cells_;
  std::optional<AtomicFile> series_;  ///< of the scenario whose rows come now
  std::string scenario_;
};

/// The same of rows that are all there.
Result<void> SaveResults(const std::filesystem::path& folder, const std::vector<Row>& rows,
                         const std::vector<ScenarioSummary>& scenarios);

/// What a reader does about a folder whose seal does not hold (seal.h).
enum class Sealing {
  kRequired,  ///< refuses it
  kIgnored,   ///< reads it, and says so in `RunData::unsealed`
};

/// Reads a result folder. Fails with file:line when a file is missing, torn or of another schema
/// version, when the run did not come to its end, and when its seal does not hold.
Result<RunData> LoadRun(const std::filesystem::path& folder, Sealing sealing = Sealing::kRequired);

/// Whether the rows are those that summary.json sums up: as many of each scenario, none twice.
Result<void> CheckRowsAgainstSummary(const std::filesystem::path& folder, const RunData& run);

}  // namespace etude
