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

/// The comparison of a cell with its second run.
struct CellCheck {
  std::string cell;
  bool same = false;
  /// The first difference: a stage whose digest differs, else "status", "reason", a metric, "curves" or "recording". If
  /// the row belongs to another cell: "scenario", "task", "cell", "clip" or "units". "" if all is the same.
  std::string stage;
  std::string then, now;  ///< the old and the new value
  /// The new row without curves and recording, if the cell was asked for by name.
  std::optional<Row> row = std::nullopt;
};

/// Compares which world and method two rows belong to.
CellCheck CompareIdentity(const Row& then, const Row& now);
/// Compares a row with that of the second run: identity, stages, status, reason, metrics.
CellCheck CompareRows(const Row& then, const Row& now);

struct ReplayOptions {
  std::string folder;
  std::vector<std::string> cells;          ///< identities as in cells.jsonl; empty = a sample
  std::optional<std::size_t> sample = {};  ///< the size of the sample; nothing = all cells
  /// Seed of the sample; nullopt = the seed of the suite, which the maker of the run knows.
  std::optional<std::uint64_t> dice = {};
  bool recorded_too = false;      ///< in addition to the sample, all cells with a recording
  bool without_programs = false;  ///< leave out cells that need outside programs
  int jobs = 0;                   ///< 0 = one per processor
  OutsideRules outside;
  std::optional<SecretKey> key = {};  ///< of secret worlds
  Sealing sealing = Sealing::kRequired;
  const std::atomic<bool>* stop = nullptr;
  OnProgress on_progress = {};  ///< counts cells
};

struct ReplayOutcome {
  std::vector<CellCheck> checks;  ///< in canonical order; only the finished ones if the replay was stopped
  CellChoice choice;
};

/// Runs cells of a finished run again, as its manifest describes them, and compares every stage, curve and recording.
Result<ReplayOutcome> ReplayRun(const ReplayOptions& options);
Result<ReplayOutcome> ReplayPrepared(const ReplayOptions& options, const RunData& run, const PreparedRun& prepared);

/// Adds a secret key to its list of used keys (NoteRepeat), if the replay asks programs that `target` names.
Result<void> NoteKey(const std::string& target, const SuiteSetup& suite, std::span<const PreparedScenario> scenarios,
                     const std::optional<SecretKey>& key);

/// Writes one file with all that is needed to repeat a cell elsewhere: the scenario, the clips, and the result.
Result<void> PackCell(const std::string& folder, const std::string& cell, const std::string& file,
                      Sealing sealing = Sealing::kRequired);

/// Runs the cell of such a file again. Returns nothing if it is stopped.
Result<std::optional<CellCheck>> ReplayPack(const std::string& file, const OutsideRules& outside = {},
                                            const std::optional<SecretKey>& key = {},
                                            const std::atomic<bool>* stop = nullptr);

}  // namespace etude
