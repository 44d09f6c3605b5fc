#include "bench/run/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/results/columns.h"
#include "bench/results/folder.h"
#include "bench/results/seal.h"
#include "bench/run/parallel_summary.h"
#include "bench/scenario/scenario.h"
#include "bench/scenario/study_of.h"
#include "engine/base/machine.h"
#include "io/files/file_path.h"
#include "io/files/files.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Returns true if `name` is the name of a part of a result folder, or of a temporary file of such a part.
bool IsPartOfRun(const fs::path& name) {
  static const std::vector<std::string> parts = {
      "manifest.json", "host.json",  kJournalFile,        kSealFile,   kCellsFile,     kTimingsFile,
      "series",        "recordings", "summary.json",      "report",    "video",        "stderr",
      kColumnsFolder,  kTimesFolder, kOtherLibrariesFile, kSignedFile, kSignatureFile, kLockFile};
  return std::any_of(parts.begin(), parts.end(),
                     [&](const std::string& part) { return name == part || name == TemporaryName(part); });
}

// Names in the temporary folder: the old run, the new folder before the two are exchanged, and files to be deleted.
constexpr const char *kOldRun = "old", *kNewRun = "new", *kGone = "gone";

bool HoldsMoreThanLock(const fs::path& folder) {
  std::error_code none;
  return std::ranges::any_of(fs::directory_iterator(folder, none), fs::directory_iterator(),
                             [](const auto& entry) { return entry.path().filename() != kLockFile; });
}

/// Gives the folder `fresh` the name `old`, and the previous `old` the name `aside`. If the file system can exchange
/// names, `fresh` and `old` are exchanged in a single (atomic) step.
bool Exchange(const fs::path& fresh, const fs::path& old, const fs::path& aside) {
  if (::renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, old.c_str(), RENAME_EXCHANGE) == 0) {
    return ::rename(fresh.c_str(), aside.c_str()) == 0;
  }
  if (::rename(old.c_str(), aside.c_str()) != 0) return false;
  if (::rename(fresh.c_str(), old.c_str()) == 0) return true;
  ::rename(aside.c_str(), old.c_str());
  return false;
}

/// Returns true if the journal has a complete first line. Otherwise the run ended before its journal was begun.
Result<bool> HoldsWholeLine(const FilePath& journal) {
  if (!Exists(journal)) return false;
  ASSIGN_OR_RETURN(auto lines, FileLines::Open(journal));
  std::string line;
  ASSIGN_OR_RETURN(const bool has_line, lines.Next(line));
  return has_line && lines.had_end();
}

}  // namespace

Result<FolderState> InspectFolder(const fs::path& path) {
  const Place place{path.string(), 0, 0};
  std::error_code error;
  if (!fs::exists(path, error)) return FolderState::kFree;
  if (!fs::is_directory(path, error)) return Fail(place, "is not a folder");
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path name = entry->path().filename();
    if (!IsPartOfRun(name)) {
      return Fail(place, "contains '{}', which is not a part of a run; choose another folder with -o", name.string());
    }
  }
  if (error) return CannotRead(path.string(), "cannot be read", error.value());
  ASSIGN_OR_RETURN(const bool is_begun, HoldsWholeLine(Inside(path) / kJournalFile));
  if (is_begun) return FolderState::kUnfinished;
  if (!Exists(Inside(path) / "host.json")) return FolderState::kFree;
  return Exists(Inside(path) / kJournalFile) ? FolderState::kUnfinished : FolderState::kFinished;
}

Result<RunFolder> RunFolder::Claim(const fs::path& path, bool keep_contents) {
  std::error_code error;
  const bool made = !fs::exists(path, error);
  fs::create_directories(path, error);
  if (error) return CannotWrite(path.string(), "cannot be made", error.value());
  RunFolder folder(path, made);
  RETURN_IF_ERROR(folder.Lock());
  if (keep_contents) return folder;
  ASSIGN_OR_RETURN(const bool has_old, folder.RestoreReplacedRun());
  if (has_old || !HoldsMoreThanLock(path)) return folder;
  if (!folder.Replace()) RETURN_IF_ERROR(folder.Empty());
  return folder;
}

std::vector<TemporaryFolder> RunFolder::FindLeft() const {
  std::error_code error;
  const fs::path path = fs::canonical(path_, error);
  if (error) return {};
  return TemporaryFolder::FindKept(path.parent_path(), path.filename().string());
}

Result<bool> RunFolder::RestoreReplacedRun() {
  // `left` holds folders of runs that were killed. Their destructors delete those that are not moved out of `left`.
  std::vector<TemporaryFolder> left = FindLeft();
  if (left.empty()) return false;
  ASSIGN_OR_RETURN(const auto state, InspectFolder(path_));
  if (state == FolderState::kFinished) return false;
  for (TemporaryFolder& one : left) {
    std::error_code error;
    const fs::path old = one.path() / kOldRun, exchanged = one.path() / kNewRun;
    // Undo an interrupted exchange: the process was killed between the two renames of `Exchange`, so the old run has
    // the name of the new folder.
    if (!fs::exists(old, error) && HoldsMoreThanLock(exchanged)) fs::rename(exchanged, old, error);
    if (!HoldsMoreThanLock(old)) continue;
    aside_ = std::move(one);
    is_ours_ = true;
    RETURN_IF_ERROR(Empty());
    return true;
  }
  return false;
}

bool RunFolder::Replace() {
  std::error_code error;
  const fs::path old = fs::canonical(path_, error);  // if `path_` is a link: its target, so that the link stays
  if (error || IsWithin(fs::current_path(error), old) || !old.has_relative_path()) return false;
  auto aside = TemporaryFolder::MakeKept(old.parent_path(), old.filename().string());
  if (!aside) return false;
  // Lock the new folder before it gets the name of the old one.
  const fs::path fresh = aside->path() / kNewRun;
  fs::create_directory(fresh, old, error);
  RunFolder successor(fresh, false);
  if (error || !successor.Lock()) return false;
  if (!Exchange(fresh, old, aside->path() / kOldRun)) return false;
  std::swap(lock_, successor.lock_);
  why_unlocked_ = successor.why_unlocked_;
  successor.path_ = aside->path() / kOldRun;  // the destructor then removes the lock file of the old run
  aside_ = std::move(*aside);
  is_ours_ = true;
  return true;
}

Result<void> RunFolder::Empty() {
  std::error_code error;
  fs::remove(path_ / "host.json", error);
  if (error) return CannotWrite(path_.string(), "cannot be emptied", error.value());
  // If another process is writing a report into the folder, wait and try again.
  constexpr int kMaxTries = 100, kPauseMicroseconds = 10'000;
  for (int tries = 0; tries < kMaxTries; ++tries) {
    error.clear();
    for (fs::directory_iterator entry(path_, error), end; !error && entry != end; entry.increment(error)) {
      if (entry->path().filename() == kLockFile) continue;
      fs::remove_all(entry->path(), error);
      if (error) break;
    }
    if (error != std::errc::directory_not_empty) break;
    ::usleep(kPauseMicroseconds);
  }
  if (error) return CannotWrite(path_.string(), "cannot be emptied", error.value());
  return {};
}

void RunFolder::Keep() {
  if (std::exchange(is_kept_, true)) return;
  is_ours_ = false;
  std::error_code ignored;
  // Rename the old run before it is deleted. If the process is killed during the deletion, the remaining files must not
  // count as a run that can be restored (RestoreReplacedRun).
  if (aside_) fs::rename(aside_->path() / kOldRun, aside_->path() / kGone, ignored);
  aside_.reset();
  // Delete the temporary folders that killed runs with `--overwrite` left; the destructors of the result delete them.
  // There are such folders if this run resumed a killed run.
  FindLeft();
}

Result<void> RunFolder::Lock() {
  const fs::path file = path_ / kLockFile;
  while (true) {
    // O_NONBLOCK: if the path is a pipe, opening it must not wait for the pipe's other end.
    lock_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, S_IWUSR);
    struct stat kind {};
    if (lock_ < 0 ? errno == ENXIO : ::fstat(lock_, &kind) == 0 && !S_ISREG(kind.st_mode)) {
      if (lock_ >= 0) ::close(std::exchange(lock_, -1));
      is_ours_ = false;
      return Fail({file.string()}, "is no file");
    }
    // This process needs no lock in a folder that it cannot write. The lock file of another user's run cannot be
    // opened.
    if (lock_ < 0 && errno == EACCES && ::access(path_.c_str(), W_OK) == 0) {
      is_ours_ = false;
      return Fail({file.string()},
                  "belongs to another user, whose run may still be writing into this folder; choose another folder "
                  "with -o, or delete the file if that run has ended");
    }
    if (lock_ < 0 && (errno == EROFS || errno == EACCES)) return {};
    if (lock_ < 0) return CannotWrite(file.string(), "cannot be made", errno);
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
      const int reason = errno;
      if (reason != EWOULDBLOCK) {
        why_unlocked_ = std::strerror(reason);
        return {};
      }
      ::close(std::exchange(lock_, -1));
      is_ours_ = false;
      return Fail({path_.string(), 0, 0}, "another run is writing into this folder; choose another folder with -o");
    }
    // If the previous owner of the lock deleted the file before this process locked it, open a new file.
    struct stat locked {
    }, named{};
    if (::fstat(lock_, &locked) == 0 && ::stat(file.c_str(), &named) == 0 && locked.st_ino == named.st_ino) return {};
    ::close(std::exchange(lock_, -1));
  }
}

RunFolder::RunFolder(RunFolder&& other) noexcept
    : path_(std::move(other.path_)),
      is_ours_(std::exchange(other.is_ours_, false)),
      is_kept_(other.is_kept_),
      lock_(std::exchange(other.lock_, -1)),
      aside_(std::exchange(other.aside_, std::nullopt)),
      why_unlocked_(std::move(other.why_unlocked_)) {}

RunFolder::~RunFolder() {
  std::error_code ignored;
  const bool is_put_back =
      is_ours_ && aside_ && Exchange(aside_->path() / kOldRun, fs::canonical(path_, ignored), aside_->path() / kGone);
  if (lock_ >= 0 && !is_put_back) fs::remove(path_ / kLockFile, ignored);
  if (is_ours_ && !is_put_back) fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

Result<bool> FinishRun(const fs::path& folder, const Plan& plan, CellTable& cells, const Json& host, int jobs,
                       const std::function<bool(double share)>& goes_on) {
  constexpr std::size_t kRowsBetweenReports = 4096;
  // Write every row, and compute the summary of each scenario.
  std::vector<Study> studies;
  for (const PreparedScenario& prepared : plan.scenarios()) studies.push_back(StudyOf(prepared.scenario()));
  ASSIGN_OR_RETURN(auto results, ResultWriter::Begin(folder, studies));
  std::vector<ScenarioSummary> summaries;
  std::size_t cell = 0;
  bool is_stopped = false;
  const auto told = [&](std::size_t read, std::size_t summarised) {  // both numbers count rows
    const double all = 2.0 * static_cast<double>(std::max<std::size_t>(1, plan.cell_count()));
    is_stopped = is_stopped || !goes_on(static_cast<double>(read + summarised) / all);
  };
  for (std::size_t s = 0; s < studies.size(); ++s) {
    const Study& study = studies[s];
    const std::size_t end =
        cell + study.conditions.size() * static_cast<std::size_t>(study.trials) * study.methods.size();
    const std::size_t first = cell, rows = end - first;
    ScenarioTable table(study);
    for (; cell < end; ++cell) {
      if (cell % kRowsBetweenReports == 0) told(cell, first);
      if (is_stopped) return false;
      ASSIGN_OR_RETURN(const auto finished, cells.Read(cell, plan));
      table.Add(finished.row);
      RETURN_IF_ERROR(results.Add(finished.row, finished.usage));
    }
    ASSIGN_OR_RETURN(auto summary, SummariseInParallel(study, table, plan.scenarios()[s].setup().seed.Public(), jobs,
                                                       [&](std::size_t done, std::size_t all) {
                                                         told(cell, first + rows * done / all);
                                                       }));
    summaries.push_back(std::move(summary));
  }
  told(cell, cell);
  if (is_stopped) return false;
  RETURN_IF_ERROR(results.Finish(summaries));
  RETURN_IF_ERROR(SaveJson(Inside(folder) / "host.json", host, OnDisk::kLater));
  // The results are now complete. Synchronise them to the disk, and only then remove the journal, which is their only
  // other copy.
  RETURN_IF_ERROR(SealRun(folder));
  RETURN_IF_ERROR(SyncTree(folder));
  RETURN_IF_ERROR(SyncPathTo(folder));
  std::error_code error;
  fs::remove(folder / kJournalFile, error);
  if (error) return CannotWrite((folder / kJournalFile).string(), "cannot be removed", error.value());
  RETURN_IF_ERROR(SyncFolder(folder));
  return true;
}

}  // namespace etude
