#include "bench/run/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <utility>

#include "bench/files/files.h"
#include "bench/results/column_index.h"
#include "bench/results/folder.h"
#include "bench/results/seal.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// The name of a part of a result folder, or of one that was being written.
bool IsPartOfRun(const fs::path& name) {
  static const std::vector<std::string> parts = {
      "manifest.json", "host.json",    kJournalFile, kSealFile, "cells.jsonl", "timings.jsonl", "series",
      "recordings",    "summary.json", "report",     "video",   "stderr",      kColumnsFolder,  kTimesFolder};
  return std::any_of(parts.begin(), parts.end(),
                     [&](const std::string& part) { return name == part || name == TemporaryName(part); });
}

/// A journal without a whole head belongs to a run that was ended while it began.
bool HoldsWholeLine(const fs::path& journal) {
  std::ifstream in(journal, std::ios::binary);
  std::string line;
  return std::getline(in, line) && !in.eof();
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
  if (HoldsWholeLine(path / kJournalFile)) return FolderState::kUnfinished;
  return fs::exists(path / "host.json", error) ? FolderState::kFinished : FolderState::kFree;
}

Result<RunFolder> RunFolder::Claim(const fs::path& path, bool keep_contents) {
  const Place place{path.string(), 0, 0};
  std::error_code error;
  const bool made = !fs::exists(path, error);
  fs::create_directories(path, error);
  if (error) return Fail(place, "cannot be made: {}", error.message());
  RunFolder folder(path, made, ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (::flock(folder.lock_, LOCK_EX | LOCK_NB) != 0) {
    folder.is_ours_ = false;
    return Fail(place, "another run is writing into it; choose another folder with -o");
  }
  if (keep_contents) return folder;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error)) {
    fs::remove_all(entry->path(), error);
    if (error) break;
  }
  if (error) return Fail(place, "cannot be emptied: {}", error.message());
  return folder;
}

RunFolder::RunFolder(RunFolder&& other) noexcept
    : path_(std::move(other.path_)),
      is_ours_(std::exchange(other.is_ours_, false)),
      lock_(std::exchange(other.lock_, -1)) {}

RunFolder::~RunFolder() {
  std::error_code ignored;
  if (is_ours_) fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace etude
