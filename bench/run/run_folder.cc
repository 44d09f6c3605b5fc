#include "bench/run/run_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/files/files.h"
#include "bench/results/folder.h"
#include "bench/results/row_json.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// The name of a part of a result folder, or of one that was being written.
bool IsPartOfRun(const fs::path& name) {
  static const std::vector<std::string> parts = {"manifest.json", "host.json", kJournalFile, "cells.jsonl",
                                                 "timings.jsonl", "series",    "recordings", "summary.json",
                                                 "report",        "video"};
  return std::any_of(parts.begin(), parts.end(),
                     [&](const std::string& part) { return name == part || name == TemporaryName(part); });
}

}  // namespace

Result<fs::path> ChooseFolder(const fs::path& folder, bool overwrite) {
  const Place place{folder.string(), 0, 0};
  std::error_code error;
  if (!fs::exists(folder, error)) return folder;
  if (!fs::is_directory(folder, error)) return Fail(place, "is no folder");
  bool holds_run = false;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const fs::path name = entry->path().filename();
    if (!IsPartOfRun(name)) {
      return Fail(place, "holds something that is no run ('{}'); choose another folder with -o", name.string());
    }
    holds_run = true;
  }
  if (error) return Fail(place, "cannot be read: {}", error.message());
  if (!holds_run) return folder;
  if (!overwrite) return Fail(place, "already holds a run; --overwrite replaces it, -o chooses another folder");
  return folder;
}

Result<RunFolder> RunFolder::Claim(const fs::path& path) {
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

Journal::Journal(const fs::path& folder) : path_(folder / kJournalFile), out_(path_, std::ios::binary) {}

Result<void> Journal::Append(const WorldAnswer& answer) {
  Json rows = Json::array();
  for (const Row& row : answer.rows) rows.push_back(EncodeRow(row));
  const auto line = WriteJson({{"world", answer.world}, {"rows", rows}, {"wall_s", answer.wall_s}});
  if (!line) return tl::unexpected(line.error());
  out_ << *line << '\n' << std::flush;
  if (!out_) return Fail({path_.string(), 0, 0}, "cannot be written (is the disk full?)");
  return {};
}

void Journal::Remove() {
  out_.close();
  std::error_code ignored;
  fs::remove(path_, ignored);
}

}  // namespace etude
