#pragma once

#include <atomic>
#include <cstdint>
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

/// The comparison of a cell's row with the row of its second run.
struct CellCheck {
  std::string cell;
  bool same = false;
  /// The name of the first difference: a stage whose digest differs, else "status", "reason", a metric, "curves" or
  /// "recording". "status" comes first if a status depends on the machine (DependsOnMachine). If the rows belong to
  /// different cells: "scenario", "task", "cell", "clip" or "units". "" if nothing differs.
  std::string stage;
  std::string then, now;  ///< the value in the old row and in the new row
  /// The new row without curves and recording, if `options.cells` names the cell.
  std::optional<Row> row = std::nullopt;
};

/// Compares the identities of two rows: scenario, task, cell, clip and sampling units.
CellCheck CompareIdentity(const Row& then, const Row& now);
/// Compares a row with the row of the second run: identity, stages, status, reason, metrics.
CellCheck CompareRows(const Row& then, const Row& now);

struct ReplayOptions {
  std::string folder;
  std::vector<std::string> cells;          ///< identities of cells, as in cells.jsonl; empty = a sample
  std::optional<std::size_t> sample = {};  ///< the size of the sample; nullopt = all cells
  /// The seed of the sample; nullopt = the seed of the suite. The maker of the run knows the suite's seed, and thus the
  /// cells that this seed draws.
  std::optional<std::uint64_t> dice = {};
  bool recorded_too = false;      ///< true: all cells with a recording are chosen in addition to the sample
  bool without_programs = false;  ///< true: cells that need outside programs are left out
  int jobs = 0;                   ///< number of worker processes; 0 = one per processor
  OutsideRules outside;
  std::optional<SecretKey> key = {};
  Sealing sealing = Sealing::kRequired;
  const std::atomic<bool>* stop = nullptr;
  OnProgress on_progress = {};  ///< receives the number of finished cells
};

struct ReplayOutcome {
  std::vector<CellCheck> checks;  ///< one check per cell, in canonical order; if the replay was stopped, finished cells
                                  ///< only
  CellChoice choice;
};

/// Runs cells of a finished run again, as the run's manifest describes them. Compares the rows (CompareRows), curves
/// and recordings.
Result<ReplayOutcome> ReplayRun(const ReplayOptions& options);
Result<ReplayOutcome> ReplayPrepared(const ReplayOptions& options, const RunData& run, const PreparedRun& prepared);

/// If the replay starts outside programs, adds an entry to the secret key's list of uses (NoteRepeat).
/// `target` is the replayed folder or file.
Result<void> NoteKey(const std::string& target, const SuiteSetup& suite, std::span<const PreparedScenario> scenarios,
                     const std::optional<SecretKey>& key);

/// Writes a file with everything that is needed to run a cell again elsewhere: the scenario, the clips and the result.
Result<void> PackCell(const std::string& folder, const std::string& cell, const std::string& file,
                      Sealing sealing = Sealing::kRequired);

/// Runs the cell in a file of PackCell again, and compares the results. Returns nothing if the user stops the run.
Result<std::optional<CellCheck>> ReplayPack(const std::string& file, const OutsideRules& outside = {},
                                            const std::optional<SecretKey>& key = {},
                                            const std::atomic<bool>* stop = nullptr);

}  // namespace etude
