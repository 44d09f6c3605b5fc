#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/row.h"
#include "bench/results/folder.h"
#include "bench/run/outside_programs.h"
#include "engine/base/progress.h"
#include "engine/base/result.h"

namespace etude {

struct PreparedRun;

/// A cell that was run again.
struct CellCheck {
  std::string cell;
  bool same = false;
  /// The place where it went another way: the first stage whose digest differs, else "status", a metric, "curves" or
  /// "recording"; "" when the same.
  std::string stage;
  std::string then, now;  ///< what stood there, what came now
  /// The row that came now, of a cell that was asked for by its name; without curves and recording.
  std::optional<Row> row = std::nullopt;
};

/// Compares a row with the one that came when the cell was run again: stage by stage, then status, then metrics.
CellCheck CompareRows(const Row& then, const Row& now);

struct ReplayOptions {
  std::string folder;
  std::vector<std::string> cells;  ///< identities as in cells.jsonl; empty = a sample
  std::size_t sample = 0;          ///< how many cells, drawn by the suite's seed; 0 = all
  bool recorded_too = false;       ///< and, of a sample, every cell that left a recording
  bool without_programs = false;   ///< leaves out cells of methods outside
  int jobs = 0;                    ///< 0 = one per processor
  OutsideRules outside;
  std::optional<SecretKey> key = {};  ///< of secret worlds
  Sealing sealing = Sealing::kRequired;
  const std::atomic<bool>* stop = nullptr;
  OnProgress on_progress = {};  ///< is told of cells
};

/// True if the run keeps a recording of the trial of this row.
bool IsRecorded(const PreparedRun& run, const Row& row);

/// Runs cells of a finished run again, as its manifest describes them, and compares every stage, curve and recording.
/// In canonical order. Stopped early, it gives those that were done.
Result<std::vector<CellCheck>> ReplayRun(const ReplayOptions& options);

/// Writes all that is needed to repeat one cell elsewhere into one file: the scenario, the clips, and what came of it.
Result<void> PackCell(const std::string& folder, const std::string& cell, const std::string& file,
                      Sealing sealing = Sealing::kRequired);

/// Runs the cell of such a file again. Nothing when it is stopped.
Result<std::optional<CellCheck>> ReplayPack(const std::string& file, const OutsideRules& outside = {},
                                            const std::optional<SecretKey>& key = {},
                                            const std::atomic<bool>* stop = nullptr);

/// One thing that a result folder says, held against what it must say.
struct Verified {
  std::string what;                      ///< "summary.json: recomputed from 480 rows"
  std::vector<std::string> differences;  ///< empty when it agrees
};

/// Holds a result folder against itself and against this program, whether or not its seal was made anew: the seal; the
/// rows, that they are those which the manifest asks for; the summary, its expectations among it, computed again from
/// them; and, with `replays`, what recordings
/// there may be and the cells that `options` choose, run again, for which secret worlds need their key. Fails when the
/// folder cannot be read. The folder's times and what it says of its machine are beyond it.
Result<std::vector<Verified>> VerifyRun(const ReplayOptions& options, bool replays);

}  // namespace etude
