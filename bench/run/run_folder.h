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
  kFree,        ///< not there, empty, or left by a run or merge that was ended with nothing to go on with
  kUnfinished,  ///< holds a journal: of an interrupted run, of one under way, or of a shard
  kFinished,    ///< holds a whole run: host.json, which is written last, and no journal
};

/// Looks at what a folder holds. Something that is no run is refused: it is never written into.
Result<FolderState> LookAtFolder(const std::filesystem::path& path);

/// A result folder that this run alone writes into. A run that ends before its first cell removes the folder if it made
/// it, and puts the run that it was to replace back in its place.
class RunFolder {
 public:
  /// Makes the folder and locks it against other runs, where the file system has locks. What is locked is a file that
  /// nobody may read: behind a fence, where nothing can be written, no method opens it, let alone locks it.
  /// Unless the contents are to be kept, the folder is empty afterwards. What it held is set aside whole, in one step:
  /// a process that reads it keeps its files, and whenever this process is killed, the folder holds the old run, or
  /// nothing of it. Where it cannot be renamed (a mount point, the working folder, a parent that may not be written),
  /// it is emptied in its place, host.json first, without which it counts as no run.
  static Result<RunFolder> Claim(const std::filesystem::path& path, bool keep_contents);
  RunFolder(RunFolder&& other) noexcept;
  ~RunFolder();

  /// Says that there is something in it worth keeping from now on; what it replaces is deleted.
  void Keep();
  /// Returns why the folder could not be locked; "" = it is locked.
  const std::string& why_unlocked() const { return why_unlocked_; }

 private:
  RunFolder(std::filesystem::path path, bool made) : path_(std::move(path)), is_ours_(made) {}
  Result<void> Lock();
  /// Puts an empty folder, locked by us, in the place of this one. False where it cannot be renamed.
  bool Replace();
  Result<void> Empty();
  /// Takes up where an overwriting of this folder was killed: the folder holds no whole run, and the one that it held
  /// before is still aside. That is put back, too, unless this run comes further. False where there is none.
  Result<bool> TakeUp();
  /// What overwritings of this folder that were killed have left.
  std::vector<TemporaryFolder> FindLeft() const;

  std::filesystem::path path_;
  bool is_ours_;                          ///< made by this run, and nothing in it yet that is worth keeping
  bool is_kept_ = false;                  ///< something is by now
  int lock_ = -1;                         ///< the lock ends with the process, however that ends
  std::optional<TemporaryFolder> aside_;  ///< holds what the folder held before, as `kOldRun`
  std::string why_unlocked_;
};

/// Writes the results of a whole run into its folder: cells, series, recordings, summary, timings and, last,
/// host.json. Then the journal, if any, is removed: without it a folder counts as finished. `cells` must be complete.
/// Many are summed up by `jobs` processes. `goes_on` is told how many rows are written, every few thousand; when it
/// says no, the folder stays unfinished. Gives whether it is finished.
Result<bool> FinishRun(const std::filesystem::path& folder, const Plan& plan, CellTable& cells, const Json& host,
                       int jobs, const std::function<bool(std::size_t rows)>& goes_on);

}  // namespace etude
