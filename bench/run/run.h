#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/journal.h"
#include "bench/run/outside_programs.h"
#include "bench/run/plan.h"
#include "bench/run/secret_key.h"
#include "bench/run/setup.h"
#include "engine/base/result.h"

namespace etude {

struct RunOptions {
  std::vector<std::string> scenarios;  ///< scenario files, or folders with *.yaml files; empty if `from` is set
  std::string text = {};               ///< text of the only file in `scenarios`; if set, the file is not read
  std::string from;                    ///< manifest.json of the run to be repeated; "" = none
  std::optional<std::uint64_t> seed;   ///< if set, replaces each scenario's own seed (by default 1)
  std::optional<SecretKey> key = {};   ///< if set, secret worlds are drawn from this key instead of the seed
  bool reuse_key = false;              ///< true: the key may have been used before (used_keys.h)
  std::optional<int> trials;           ///< if set, replaces each scenario's own number of trials
  std::vector<std::string> clips;      ///< if not empty, replaces the scenarios' clips
  std::vector<std::string> libraries;  ///< libraries as NAME=CLIPS, in addition to those of the scenarios
  /// Recordings; if not empty, they replace simulated people and the scenarios' recordings.
  std::vector<std::string> streams;
  std::string labels;           ///< file with the labels of `streams`, or of `clips`
  std::string joint_map;        ///< file of joint names; if not "", replaces the scenarios' joint maps
  std::string clip_facts = {};  ///< additional lines of the joint map, such as "unit: cm\n"
  bool skip_refused = false;    ///< true: clips that cannot be read are left out, and the manifest lists them
  bool keeps_motions = false;   ///< true: every cell is recorded
  std::string output;           ///< the result folder; "" = out/<suite>-<seed>, followed by "-<i>-of-<n>" for a shard
  bool overwrite = false;       ///< true: a run that the folder contains is replaced
  bool resume = false;          ///< true: the run that the folder contains is continued
  /// True: the run may be resumed although libraries have changed; the folder records the changes.
  bool other_libraries = false;
  Shard shard;   ///< the part of the run to do; by default the whole run
  int jobs = 0;  ///< number of worker processes; 0 = one per processor
  OutsideRules outside;
  JournalLag sync;           ///< limits on the size and age of results that are not yet on the disk
  std::string command_line;  ///< the command line that host.json records
  std::string program_version;
  const std::atomic<bool>* stop = nullptr;
};

/// The progress of a run. It is reported before the first cell, whenever further cells are safe on the disk, and once a
/// second.
struct Progress {
  std::size_t cells = 0;  ///< number of all cells of this run or shard
  std::size_t cells_done = 0;
  std::size_t cells_ok = 0;
  /// Number of cells that are answered but not yet measured by outside metric programs.
  std::size_t cells_answered = 0;
  /// The work of all cells and of the done ones, in yardsticks if the costs of scenarios are known, else in cells. A
  /// cell that is answered but not yet measured counts a half.
  double work = 0, work_done = 0;
  double work_before = 0;  ///< work that an interrupted run had already done, if this run resumes it
  /// The wall time of a unit of `work` with all workers, as expected when the run began, seconds; 0 = unknown.
  double seconds_per_work = 0;
  double seconds = 0;
  /// The share of the results that has been summarised and written; nullopt while cells still run.
  std::optional<double> written = {};

  /// Estimates the time until all cells are done, seconds; 0 = unknown. The expected time per unit of work
  /// (`seconds_per_work`) has the weight of a measurement over a tenth of the work.
  double SecondsToGo() const {
    const double expected = seconds_per_work > 0 ? 0.1 * work : 0, done = expected + work_done - work_before;
    return done <= 0 ? 0 : (expected * seconds_per_work + seconds) / done * (work - work_done);
  }
};

/// A sentence for users about a clip file: an observation, or a change that reading made to the content.
struct LoadedChange {
  std::string clip, change;
};

struct RunOutcome {
  std::filesystem::path folder;
  std::size_t cells = 0;  ///< number of cells with a row
  std::size_t cells_ok = 0;
  /// Number of cells that are answered but not yet measured, because the run ended early.
  std::size_t cells_answered = 0;
  double seconds = 0;
  bool stopped = false;                    ///< true: the user stopped the run; the journal has the finished cells
  std::string fence = {};                  ///< description of the sandbox of outside programs; "" = there were none
  std::vector<RefusedClip> refused = {};   ///< clips and recordings that a scenario left out, each listed once
  std::vector<Error> unfilmed = {};        ///< scenarios whose `video` selects no trial of this run
  std::vector<LoadedChange> changes = {};  ///< changes that reading made to the content of clip files, each listed once
  std::string why_unlocked = {};  ///< why the folder could not be locked against other runs; "" = it was locked
  /// Line numbers of the damaged lines in the journal of a resumed run. The cells of these lines were run again.
  std::vector<int> damaged_lines = {};
};

/// Runs scenarios and writes a result folder. All input is checked before anything is written. Each finished cell is
/// written to journal.jsonl immediately; the journal is synchronised to the disk in groups of cells. A run that was
/// ended at any moment, by a kill or a power cut, can be resumed; its results then have the same bytes as those of a
/// run without interruption, apart from times. A shard keeps its journal for Merge. If no cell is finished, a new
/// folder is removed again.
Result<RunOutcome> Run(const RunOptions& options, const std::function<void(const Progress&)>& on_progress);

struct MergeOptions {
  std::vector<std::string> folders;  ///< folders of the shards 1/n … n/n, in any order
  std::string output;
  bool overwrite = false;
  std::optional<SecretKey> key = {};  ///< key of secret worlds, if the run has them
  /// True: the shards may have run with different libraries; the merged folder records the differences.
  bool other_libraries = false;
  std::string command_line;
  std::string program_version;
  const std::atomic<bool>* stop = nullptr;
};

/// Merges the shards of a run. The manifest, rows, curves, recordings and summary have the same bytes as those of a
/// run without shards. Fails, with a list, if shards have different builds, suites or seeds, if shards overlap, or if
/// cells are missing. If the user stops the merge, no files are left. `on_progress` receives the share of rows that
/// have been read and written. Even if this share is 1, the merge has succeeded only when this function returns.
Result<RunOutcome> Merge(const MergeOptions& options, const std::function<void(double share)>& on_progress);

}  // namespace etude
