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
  kFree,        ///< missing, empty, or left by a run or merge that ended before its first result
  kUnfinished,  ///< holds a journal: an interrupted run, a run in progress, or a shard
  kFinished,    ///< holds a whole run: host.json, which is written last, and no journal
};

/// Examines the contents of a folder. Fails if it contains anything that is not part of a run; nothing is ever written
/// into such a folder.
Result<FolderState> LookAtFolder(const std::filesystem::path& path);

/// A result folder into which only this run writes. If the run ends before its first cell, the destructor removes the
/// folder if this run made it, and restores the run that was to be replaced.
class RunFolder {
 public:
  /// Makes the folder, and locks it against other runs if the file system has locks. The lock file is not readable, so
  /// a method behind the fence cannot open and lock it. Unless `keep_contents` is true, the folder is empty afterwards:
  /// its old content is moved away in a single step. A process that is reading the old run keeps its files. A kill at
  /// any moment leaves the whole old run or none of it. If the folder cannot be renamed (a mount point, the working
  /// folder, a parent without write permission), it is emptied in place. host.json is removed first, because a folder
  /// without it does not count as a run.
  static Result<RunFolder> Claim(const std::filesystem::path& path, bool keep_contents);
  RunFolder(RunFolder&& other) noexcept;
  ~RunFolder();

  /// Declares that the folder contains results to keep, and deletes the replaced run.
  void Keep();
  /// Returns the reason why the folder could not be locked; "" = it is locked.
  const std::string& why_unlocked() const { return why_unlocked_; }

 private:
  RunFolder(std::filesystem::path path, bool made) : path_(std::move(path)), is_ours_(made) {}
  Result<void> Lock();
  /// Exchanges this folder for an empty, locked one. Returns false if the folder cannot be renamed.
  bool Replace();
  Result<void> Empty();
  /// Recovers the old run that a killed `--overwrite` moved aside, if this folder contains no finished run. The
  /// destructor restores the old run, unless Keep is called. Returns false if there is no old run.
  Result<bool> TakeUp();
  /// Returns the temporary folders of killed `--overwrite` runs.
  std::vector<TemporaryFolder> FindLeft() const;

  std::filesystem::path path_;
  bool is_ours_;                          ///< true: this run made the folder, and there are no results to keep yet
  bool is_kept_ = false;                  ///< Keep was called
  int lock_ = -1;                         ///< released by the system when the process ends
  std::optional<TemporaryFolder> aside_;  ///< holds the folder's old content, as `kOldRun`
  std::string why_unlocked_;
};

/// Writes the results of a whole run into its folder: cells, series, recordings, summary, timings, and last host.json.
/// Then removes the journal, after which the folder counts as finished. `cells` must be complete. `jobs` processes
/// share the statistics of large runs. `goes_on` receives the finished share of this work after every few thousand rows
/// and after each part of the statistics. If it returns false, the folder stays unfinished. Returns true if the folder
/// is finished.
Result<bool> FinishRun(const std::filesystem::path& folder, const Plan& plan, CellTable& cells, const Json& host,
                       int jobs, const std::function<bool(double share)>& goes_on);

}  // namespace etude
