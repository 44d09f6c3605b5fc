#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/run/journal.h"
#include "engine/base/result.h"
#include "io/files/json.h"
#include "io/files/temporary_folder.h"

namespace etude {

enum class FolderState {
  /// The folder is missing or empty, or it has neither a journal nor host.json: a run ended before it began its
  /// journal, or a merge ended before it had written all results.
  kFree,
  /// The folder has a journal: it belongs to an interrupted run, a run in progress, or a shard. If the folder has
  /// host.json, the journal may have lost its lines.
  kUnfinished,
  kFinished,  ///< the folder has no journal, but has host.json, which is written after all results of a whole run
};

/// Examines the contents of a folder. Fails if the folder contains anything that is not part of a run, because a run
/// must never write into such a folder.
Result<FolderState> InspectFolder(const std::filesystem::path& path);

/// A result folder into which only this run writes. If the run ends before its first cell, the destructor removes the
/// folder that this run made, and restores the run that was to be replaced.
class RunFolder {
 public:
  /// Makes the folder, and locks it against other runs if the file system has locks. The lock file is not readable, so
  /// a method in the sandbox cannot open and lock it. Unless `keep_contents` is true, the folder is empty afterwards:
  /// its old content is moved to a temporary folder in a single step, and a process that is reading the old run can go
  /// on reading. If the process is killed at any moment, either the whole old run is there or nothing of it. If the
  /// folder cannot be renamed (a mount point, the working folder, a parent without write permission), its files are
  /// deleted one by one. host.json is deleted first, because a folder without it does not count as a run.
  static Result<RunFolder> Claim(const std::filesystem::path& path, bool keep_contents);
  RunFolder(RunFolder&& other) noexcept;
  ~RunFolder();

  /// Declares that the folder contains results that must stay, and deletes the replaced run.
  void Keep();
  /// Returns the reason why the folder could not be locked; "" if it is locked.
  const std::string& why_unlocked() const { return why_unlocked_; }

 private:
  RunFolder(std::filesystem::path path, bool made) : path_(std::move(path)), is_ours_(made) {}
  Result<void> Lock();
  /// Exchanges this folder for an empty, locked one. Returns false if the folder cannot be renamed.
  bool Replace();
  Result<void> Empty();
  /// Finds the old run that a killed run with `--overwrite` moved aside; the destructor then restores the old run,
  /// unless Keep is called. Returns false if there is no old run, or if this folder contains a finished run.
  Result<bool> RestoreReplacedRun();
  /// Returns the temporary folders that killed runs with `--overwrite` left.
  std::vector<TemporaryFolder> FindLeft() const;

  std::filesystem::path path_;
  bool is_ours_;          ///< true: this run made or emptied the folder, which has no results to keep yet
  bool is_kept_ = false;  ///< true: Keep was called
  int lock_ = -1;         ///< file descriptor of the lock file; the system releases the lock when the process ends
  /// The temporary folder whose subfolder `kOldRun` is the replaced run; nullopt if nothing is replaced.
  std::optional<TemporaryFolder> aside_;
  std::string why_unlocked_;
};

/// Writes the results of a whole run into its folder: cells, series, recordings, summary and timings, then host.json,
/// and last the seal. Then removes the journal, so that the folder counts as finished. `cells` must be complete. If the
/// run is large, `jobs` processes compute the statistics. `goes_on` receives the finished share of all this work, after
/// every few thousand rows and after each part of the statistics. If `goes_on` returns false, this function stops and
/// returns false, and the folder stays unfinished. Otherwise returns true.
Result<bool> FinishRun(const std::filesystem::path& folder, const Plan& plan, CellTable& cells, const Json& host,
                       int jobs, const std::function<bool(double share)>& goes_on);

}  // namespace etude
