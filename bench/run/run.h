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
  std::vector<std::string> scenarios;  ///< files, or folders of *.yaml; empty with `from`
  std::string text = {};               ///< the text of the only file in `scenarios`, which is then not read
  std::string from;                    ///< the manifest.json of the run that is repeated
  std::optional<std::uint64_t> seed;   ///< replaces each scenario's own seed (by default 1)
  std::optional<SecretKey> key = {};   ///< the key of secret worlds; instead of a seed
  bool reuse_key = false;              ///< true: a key that was used before is accepted (used_keys.h)
  std::optional<int> trials;           ///< replaces each scenario's own number
  std::vector<std::string> clips;      ///< if not empty, replaces the scenarios' clips
  std::vector<std::string> libraries;  ///< NAME=CLIPS, in addition to the scenarios' libraries
  std::vector<std::string> streams;    ///< if not empty, replaces simulated people and the scenarios' recordings
  std::string labels;                  ///< labels of `streams`, or of `clips`
  std::string joint_map;               ///< if not empty, replaces the scenarios' joint maps
  std::string clip_facts = {};         ///< additional lines of the joint map, such as "unit: cm\n"
  bool skip_refused = false;           ///< true: clips that cannot be read are left out; the manifest lists them
  bool keeps_motions = false;          ///< true: every cell is recorded
  std::string output;                  ///< "" = out/<suite>-<seed>, and "-<i>-of-<n>" for a shard
  bool overwrite = false;              ///< true: a run in the folder is replaced
  bool resume = false;                 ///< true: the run in the folder is continued
  bool other_libraries = false;        ///< true: resume even if libraries have changed; the folder records it
  Shard shard;                         ///< the part of the run that is done here
  int jobs = 0;                        ///< worker processes; 0 = one per processor
  OutsideRules outside;
  JournalLag sync;           ///< the maximum amount of results not yet on the disk
  std::string command_line;  ///< the command line that host.json records
  std::string program_version;
  const std::atomic<bool>* stop = nullptr;
};

/// The progress of a run. It is reported before the first cell, whenever more cells are safe on the disk, and once a
/// second.
struct Progress {
  std::size_t cells = 0;  ///< all cells of this run or shard
  std::size_t cells_done = 0;
  std::size_t cells_ok = 0;
  std::size_t cells_answered = 0;  ///< answered, but not yet measured by programs
  double work_before = 0;          ///< Work() of the interrupted run that this one resumes
  double seconds = 0;
  /// The share of the results that is summarised and written; nullopt until all cells have ended.
  std::optional<double> written = {};

  /// Returns the number of finished cells. An answered cell that is not yet measured counts half.
  double Work() const { return static_cast<double>(cells_done) + 0.5 * static_cast<double>(cells_answered); }
};

/// A sentence for users about a clip's file: an observation, or a change that reading made to the file's content.
struct LoadedChange {
  std::string clip, change;
};

struct RunOutcome {
  std::filesystem::path folder;
  std::size_t cells = 0;  ///< cells with a row
  std::size_t cells_ok = 0;
  std::size_t cells_answered = 0;  ///< answered, but not yet measured, because the run ended early
  double seconds = 0;
  bool stopped = false;                   ///< true: it ended early; the journal holds the finished cells
  std::string fence = {};                 ///< description of the sandbox of outside programs; "" = there were none
  std::vector<RefusedClip> refused = {};  ///< clips and recordings left out of any scenario, each listed once
  std::vector<LoadedChange> changes = {};  ///< changes made to the content of clip files, each once
  std::string why_unlocked = {};          ///< why the folder could not be locked against other runs; "" = it was locked
  /// The line numbers of damaged lines in the journal of a resumed run. The cells of these lines were run again.
  std::vector<int> damaged_lines = {};
};

/// Runs scenarios and writes a result folder. All input is checked before anything is written. Each finished cell is
/// written to journal.jsonl at once; the journal is synchronised to the disk in groups of cells. A run that was ended
/// at any moment, by a kill or a power cut, can be resumed, and the result has the same bytes. A shard keeps its
/// journal for Merge. If no cell is finished, a new folder is removed again.
Result<RunOutcome> Run(const RunOptions& options, const std::function<void(const Progress&)>& on_progress);

struct MergeOptions {
  std::vector<std::string> folders;  ///< folders of the shards 1/n … n/n, in any order
  std::string output;
  bool overwrite = false;
  std::optional<SecretKey> key = {};  ///< the key of secret worlds
  bool other_libraries = false;  ///< true: shards may have run under different libraries; the result records it
  std::string command_line;
  std::string program_version;
  const std::atomic<bool>* stop = nullptr;
};

/// Merges the shards of a run. The result has the same bytes as a run in one piece. Fails, with a list, if shards have
/// different builds, suites or seeds, if shards overlap, or if cells are missing. If the user stops the merge, it
/// leaves no files. `on_progress` receives the share of rows that are read and written; even at 1, the merge has
/// succeeded only when this function returns.
Result<RunOutcome> Merge(const MergeOptions& options, const std::function<void(double share)>& on_progress);

}  // namespace etude
