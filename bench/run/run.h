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
  std::vector<std::string> scenarios;  ///< files, or folders of *.yaml; none with `from`
  std::string from;                    ///< the manifest.json of a run to be repeated
  std::optional<std::uint64_t> seed;   ///< else each scenario's own, else 1
  std::optional<SecretKey> key = {};   ///< of secret worlds, in the place of a seed
  bool reuse_key = false;              ///< take a key that was used before (used_keys.h)
  std::optional<int> trials;           ///< else each scenario's own
  std::vector<std::string> clips;      ///< replaces the scenarios' clips when not empty
  std::vector<std::string> libraries;  ///< NAME=CLIPS, beside the scenarios' libraries; one name may stand repeatedly
  std::vector<std::string> streams;  ///< in the place of simulated people or the scenarios' recordings, when not empty
  std::string labels;                ///< of `streams`, or of `clips`
  std::string joint_map;             ///< replaces the scenarios' joint maps when not empty
  std::string clip_facts = {};       ///< further lines of that file, such as "unit: cm\n"
  bool skip_refused = false;         ///< leave out clips that cannot be read; the manifest names them
  bool keeps_motions = false;        ///< record every cell
  std::string output;                ///< "" = out/<suite>-<seed>, and "-<i>-of-<n>" for a shard
  bool overwrite = false;            ///< replace a folder that already holds a run
  bool resume = false;               ///< go on with the run that the folder holds
  bool other_libraries = false;      ///< … even where libraries have changed since; the folder records it
  Shard shard;                       ///< run this part only
  int jobs = 0;                      ///< worker processes; 0 = one per processor
  OutsideRules outside;
  JournalLag sync;           ///< how far the disk may be behind
  std::string command_line;  ///< for host.json
  std::string program_version;
  const std::atomic<bool>* stop = nullptr;
};

/// The progress of a run: told before the first cell, and whenever more cells are safe on the disk.
struct Progress {
  std::size_t cells = 0;  ///< of this run or shard
  std::size_t cells_done = 0;
  std::size_t cells_ok = 0;
  std::size_t cells_answered = 0;  ///< others, which have yet to be measured by programs
  double work_before = 0;          ///< Work() of the run that this one resumes
  double seconds = 0;

  /// Counts cells that are done; one that has yet to be measured is half of its way.
  double Work() const { return static_cast<double>(cells_done) + 0.5 * static_cast<double>(cells_answered); }
};

/// What was found in a clip's file, or changed of what it holds, for people.
struct LoadedChange {
  std::string clip, change;
};

struct RunOutcome {
  std::filesystem::path folder;
  std::size_t cells = 0;  ///< that have their row
  std::size_t cells_ok = 0;
  std::size_t cells_answered = 0;  ///< others, which have yet to be measured; when it ended early
  double seconds = 0;
  bool stopped = false;                   ///< ended early; the journal holds what was done
  std::string fence = {};                 ///< what methods outside ran in; "" = there were none
  std::vector<RefusedClip> refused = {};  ///< left out of all scenarios together, each once
  std::vector<LoadedChange> changes = {};  ///< what was changed of what clips' files hold, each once
  std::string why_unlocked = {};          ///< nothing kept other runs out of the folder; "" = a lock did
  /// Lines of the journal gone on with that were not as they had been written; their cells were run again.
  std::vector<int> damaged_lines = {};
};

/// Runs scenarios into a result folder. Everything that can be wrong with the input is found before anything is
/// written; from then on, every cell that ends is written to journal.jsonl at once and synchronised in groups;
/// a run that was ended at any moment, by a kill or a power cut, can be resumed to the same bytes. A shard leaves its
/// journal, for Merge. A run that ends before any cell did leaves no folder that was not there before.
Result<RunOutcome> Run(const RunOptions& options, const std::function<void(const Progress&)>& on_progress);

struct MergeOptions {
  std::vector<std::string> folders;  ///< of the shards 1/n … n/n, in any order
  std::string output;
  bool overwrite = false;
  std::optional<SecretKey> key = {};  ///< of secret worlds
  bool other_libraries = false;       ///< shards may have run under different libraries; the merged folder records it
  std::string command_line;
  std::string program_version;
  const std::atomic<bool>* stop = nullptr;
};

/// Makes one run of its shards: the same bytes as a run in one piece. Shards of different builds, suites or
/// seeds, shards that overlap, and cells that are missing are refused with a list. Stopped, it leaves nothing. Its
/// progress is the share of rows that are written, and promises nothing: only its end does.
Result<RunOutcome> Merge(const MergeOptions& options, const std::function<void(double share)>& on_progress);

}  // namespace etude
