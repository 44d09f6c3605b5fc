#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/model/row.h"
#include "bench/replay/cell_choice.h"
#include "bench/results/folder.h"
#include "bench/run/outside_programs.h"
#include "engine/base/progress.h"
#include "engine/base/result.h"

namespace etude {

/// A cell that was run again.
struct CellCheck {
  std::string cell;
  bool same = false;
  /// The place where it went another way: the first stage whose digest differs, else "status", a metric, "curves" or
  /// "recording"; "cell", "task", "clip" or "units" of a row that is another's; "" when the same.
  std::string stage;
  std::string then, now;  ///< what stood there, what came now
  /// The row that came now, of a cell that was asked for by its name; without curves and recording.
  std::optional<Row> row = std::nullopt;
};

/// Compares what rows say of their world and method.
CellCheck CompareIdentity(const Row& then, const Row& now);
/// Compares a row with the one that came when the cell was run again: whose it is, stage by stage, status, metrics.
CellCheck CompareRows(const Row& then, const Row& now);

struct ReplayOptions {
  std::string folder;
  std::vector<std::string> cells;          ///< identities as in cells.jsonl; empty = a sample
  std::optional<std::size_t> sample = {};  ///< so many cells are drawn; nothing = all
  std::optional<std::uint64_t> dice = {};  ///< by this seed; nothing = the suite's, which whoever made the run knows
  bool recorded_too = false;               ///< and, beside a sample, every cell that left a recording
  bool without_programs = false;           ///< leaves out cells of methods outside
  int jobs = 0;                            ///< 0 = one per processor
  OutsideRules outside;
  std::optional<SecretKey> key = {};  ///< of secret worlds
  Sealing sealing = Sealing::kRequired;
  const std::atomic<bool>* stop = nullptr;
  OnProgress on_progress = {};  ///< is told of cells
};

struct ReplayOutcome {
  std::vector<CellCheck> checks;  ///< in canonical order; of a replay that was stopped early, those that were done
  CellChoice choice;
};

/// Runs cells of a finished run again, as its manifest describes them, and compares every stage, curve and recording.
Result<ReplayOutcome> ReplayRun(const ReplayOptions& options);
/// The same, of a run that was read and made ready.
Result<ReplayOutcome> ReplayPrepared(const ReplayOptions& options, const RunData& run, const PreparedRun& prepared);

/// Notes a secret key beside its file as used, where cells of `target` are run again by programs that it names.
Result<void> NoteKey(const std::string& target, const SuiteSetup& suite, std::span<const PreparedScenario> scenarios,
                     const std::optional<SecretKey>& key);

/// Writes all that is needed to repeat one cell elsewhere into one file: the scenario, the clips, and what came of it.
Result<void> PackCell(const std::string& folder, const std::string& cell, const std::string& file,
                      Sealing sealing = Sealing::kRequired);

/// Runs the cell of such a file again. Nothing when it is stopped.
Result<std::optional<CellCheck>> ReplayPack(const std::string& file, const OutsideRules& outside = {},
                                            const std::optional<SecretKey>& key = {},
                                            const std::atomic<bool>* stop = nullptr);

}  // namespace etude
