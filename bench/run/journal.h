#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/cell_runner.h"
#include "bench/run/plan.h"

namespace etude {

/// What the cells of a journal belong to: only cells of the same build, suite and seed can stand together.
struct JournalHead {
  std::string manifest;  ///< digest of manifest.json
  std::string build;     ///< digest of the program
  Shard shard;
};

/// The finished cells of a run or of a shard, by their number in the plan; empty where there is none yet.
using CellTable = std::vector<std::optional<FinishedCell>>;

/// The append-only record of a run that is under way, and all that is left of a finished shard: JSON Lines, a
/// head and then one line per cell in order of completion, each flushed at once.
class Journal {
 public:
  /// Begins a journal.
  static Result<Journal> Begin(const std::filesystem::path& folder, const JournalHead& head);
  /// Goes on with one that `ReadJournal` has read; a last line that was torn is cut off.
  static Result<Journal> Continue(const std::filesystem::path& folder);
  Journal(Journal&& other) noexcept;
  ~Journal();

  Result<void> Append(std::size_t cell, FinishedCell finished);

 private:
  Journal(std::filesystem::path path, int file) : path_(std::move(path)), file_(file) {}
  Result<void> Write(const std::string& line);

  std::filesystem::path path_;
  int file_ = -1;
};

/// Reads the head alone.
Result<JournalHead> ReadJournalHead(const std::filesystem::path& folder);

/// Puts the cells of a journal into `cells` (one place per cell of `plan`). A last line without its end is what a kill
/// leaves, and ignored; any other line that cannot be read, is no cell of the plan or of the shard, or stands there
/// already, is refused with file:line.
Result<JournalHead> ReadJournal(const std::filesystem::path& folder, const Plan& plan, CellTable& cells);

/// Which cells are there.
std::vector<bool> DoneCells(const CellTable& cells);

}  // namespace etude
