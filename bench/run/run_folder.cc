#include "bench/run/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/files/files.h"
#include "bench/results/columns.h"
#include "bench/results/folder.h"
#include "bench/results/seal.h"
#include "bench/run/sum_up.h"
#include "bench/scenario/scenario.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// The name of a part of a result folder, or of one that was being written.
bool IsPartOfRun(const fs::path& name) {
  static const std::vector<std::string> parts = {
      "manifest.json", "host.json",  kJournalFile,        kSealFile,   kCellsFile,     kTimingsFile,
      "series",        "recordings", "summary.json",      "report",    "video",        "stderr",
      kColumnsFolder,  kTimesFolder, kOtherLibrariesFile, kSignedFile, kSignatureFile, kLockFile};
  return std::any_of(parts.begin(), parts.end(),
                     [&](const std::string& part) { return name == part || name == TemporaryName(part); });
}

/// A journal without a whole head belongs to a run that was ended while it began.
Result<bool> HoldsWholeLine(const FilePath& journal) {
  if (!Exists(journal)) return false;
  ASSIGN_OR_RETURN(auto lines, FileLines::Open(journal));
  std::string line;
  ASSIGN_OR_RETURN(const bool has_line, lines.Next(line));
  return has_line && lines.had_end();
}

}  // namespace

Result<FolderState> LookAtFolder(const fs::path& path) {
  const Place place{path.string(), 0, 0};
  std::error_code error;
  if (!fs::exists(path, error)) return FolderState::kFree;
  if (!fs::is_directory(path, error)) return Fail(place, "is no folder");
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path name = entry->path().filename();
    if (!IsPartOfRun(name)) {
      return Fail(place, "holds something that is no run ('{}'); choose another folder with -o", name.string());
    }
  }
  if (error) return Fail(place, "cannot be read: {}", error.message());
  ASSIGN_OR_RETURN(const bool is_begun, HoldsWholeLine(Inside(path) / kJournalFile));
  if (is_begun) return FolderState::kUnfinished;
  return Exists(Inside(path) / "host.json") ? FolderState::kFinished : FolderState::kFree;
}

Result<RunFolder> RunFolder::Claim(const fs::path& path, bool keep_contents) {
  const Place place{path.string(), 0, 0};
  std::error_code error;
  const bool made = !fs::exists(path, error);
  fs::create_directories(path, error);
  if (error) return Fail(place, "cannot be made: {}", error.message());
  RunFolder folder(path, made);
  RETURN_IF_ERROR(folder.Lock());
  if (keep_contents) return folder;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().filename() == kLockFile) continue;
    fs::remove_all(entry->path(), error);
    if (error) break;
  }
  if (error) return Fail(place, "cannot be emptied: {}", error.message());
  return folder;
}

Result<void> RunFolder::Lock() {
  const fs::path file = path_ / kLockFile;
  while (true) {
    lock_ = ::open(file.c_str(), O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, S_IWUSR);
    if (lock_ < 0 && (errno == EROFS || errno == EACCES)) return {};  // nobody writes here
    if (lock_ < 0) return Fail({file.string(), 0, 0}, "cannot be made: {}", std::strerror(errno));
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
      const int reason = errno;
      if (reason != EWOULDBLOCK) {
        why_unlocked_ = std::strerror(reason);
        return {};
      }
      ::close(std::exchange(lock_, -1));
      is_ours_ = false;
      return Fail({path_.string(), 0, 0}, "another run is writing into it; choose another folder with -o");
    }
    // The run that had it before may have taken it away meanwhile.
    struct stat locked {
    }, named{};
    if (::fstat(lock_, &locked) == 0 && ::stat(file.c_str(), &named) == 0 && locked.st_ino == named.st_ino) return {};
    ::close(std::exchange(lock_, -1));
  }
}

RunFolder::RunFolder(RunFolder&& other) noexcept
    : path_(std::move(other.path_)),
      is_ours_(std::exchange(other.is_ours_, false)),
      lock_(std::exchange(other.lock_, -1)),
      why_unlocked_(std::move(other.why_unlocked_)) {}

RunFolder::~RunFolder() {
  std::error_code ignored;
  if (lock_ >= 0) fs::remove(path_ / kLockFile, ignored);
  if (is_ours_) fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

namespace fs = std::filesystem;

Result<bool> FinishRun(const fs::path& folder, const Plan& plan, CellTable& cells, const Json& host, int jobs,
                       const std::function<bool(std::size_t rows)>& goes_on) {
  constexpr std::size_t kRowsBetweenReports = 4096;
  std::vector<Study> studies;
  for (const PreparedScenario& prepared : plan.scenarios()) studies.push_back(StudyOf(prepared.scenario()));
  ASSIGN_OR_RETURN(auto results, ResultWriter::Begin(folder, studies));
  std::vector<ScenarioSummary> summaries;
  std::size_t cell = 0;
  for (std::size_t s = 0; s < studies.size(); ++s) {
    const Study& study = studies[s];
    const std::size_t end =
        cell + study.conditions.size() * static_cast<std::size_t>(study.trials) * study.methods.size();
    ScenarioTable table(study);
    for (; cell < end; ++cell) {
      if (cell % kRowsBetweenReports == 0 && !goes_on(cell)) return false;
      ASSIGN_OR_RETURN(const auto finished, cells.Read(cell, plan));
      table.Add(finished.row);
      RETURN_IF_ERROR(results.Add(finished.row, finished.usage));
    }
    ASSIGN_OR_RETURN(auto summary, SumUp(study, table, plan.scenarios()[s].setup().seed.Public(), jobs));
    summaries.push_back(std::move(summary));
  }
  if (!goes_on(cell)) return false;
  RETURN_IF_ERROR(results.Finish(summaries));
  RETURN_IF_ERROR(SaveJson(Inside(folder) / "host.json", host, OnDisk::kLater));
  // The journal is the only other place that knows the results: it goes when all of them are on the disk.
  RETURN_IF_ERROR(SealRun(folder));
  RETURN_IF_ERROR(SyncTree(folder));
  RETURN_IF_ERROR(SyncPathTo(folder));
  std::error_code error;
  fs::remove(folder / kJournalFile, error);
  if (error) return Fail({(folder / kJournalFile).string(), 0, 0}, "cannot be removed: {}", error.message());
  RETURN_IF_ERROR(SyncFolder(folder));
  return true;
}

}  // namespace etude
