#include "io/files/temporary_folder.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "engine/base/machine.h"

namespace etude {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPrefix = "etude-temporary-";  // a prefix that is unlikely for a folder of results
constexpr const char* kKeptPrefix = "etude-kept-";
constexpr std::size_t kSuffixLength = 7;  // length of "-XXXXXX", which mkdtemp replaces

/// Opens and locks a folder; returns −1 if another process has the lock or the folder belongs to another user.
int Lock(const fs::path& folder) {
  const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  struct stat status {};
  const bool is_ours = lock >= 0 && ::fstat(lock, &status) == 0 && status.st_uid == ::geteuid();
  if (is_ours && ::flock(lock, LOCK_EX | LOCK_NB) == 0) return lock;
  if (lock >= 0) ::close(lock);
  return -1;
}

/// Makes a folder; returns the folder's path and lock. The folder gets its final name only after it is locked;
/// otherwise another process could delete it as abandoned.
Result<std::pair<fs::path, int>> MakeLocked(const fs::path& parent, const std::string& start) {
  std::string name = (parent / ("." + start + "-XXXXXX")).string();
  const bool made = ::mkdtemp(name.data()) != nullptr;
  const int lock = made ? Lock(name) : -1;
  const fs::path path = parent / fs::path(name).filename().string().substr(1);
  if (made && ::rename(name.c_str(), path.c_str()) == 0) return std::pair(path, lock);
  const int reason = errno;
  if (lock >= 0) ::close(lock);
  if (made) ::rmdir(name.c_str());
  return Fail({parent.string()}, "cannot create temporary files in this folder: {}", std::strerror(reason));
}

}  // namespace

Result<TemporaryFolder> TemporaryFolder::Make(const std::string& purpose) {
  const char* told = ::getenv("TMPDIR");
  const fs::path parent = told != nullptr && *told != '\0' ? told : "/tmp";
  const std::string place = told != nullptr ? "TMPDIR=" + parent.string() : parent.string();
  std::error_code error;
  if (!fs::is_directory(parent, error)) {
    return FailOfMachine("{} is not a folder for temporary files{}", place, error ? ": " + error.message() : "");
  }
  if (!parent.is_absolute()) {
    return FailOfMachine("{} is not a folder for temporary files; allowed: a path that begins with /", place);
  }
  auto folder = MakeIn(parent, purpose);
  if (!folder) return FailOfMachine("{}: {}", place, folder.error().message);
  return folder;
}

Result<TemporaryFolder> TemporaryFolder::MakeIn(const fs::path& parent, const std::string& purpose) {
  RemoveAbandoned(parent);
  ASSIGN_OR_RETURN(const auto made, MakeLocked(parent, kPrefix + purpose));
  return TemporaryFolder(made.first, made.second);
}

Result<TemporaryFolder> TemporaryFolder::MakeKept(const fs::path& parent, const std::string& kept) {
  ASSIGN_OR_RETURN(const auto made, MakeLocked(parent, kKeptPrefix + kept));
  return TemporaryFolder(made.first, made.second);
}

std::vector<TemporaryFolder> TemporaryFolder::FindKept(const fs::path& parent, const std::string& kept) {
  std::vector<TemporaryFolder> found;
  const std::string start = kKeptPrefix + kept;
  std::error_code error;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.size() != start.size() + kSuffixLength || !name.starts_with(start + "-")) continue;
    if (const int lock = Lock(entry->path()); lock >= 0) found.push_back(TemporaryFolder(entry->path(), lock));
  }
  return found;
}

void TemporaryFolder::RemoveAbandoned() {
  std::error_code none;
  RemoveAbandoned(fs::temp_directory_path(none));
}

void TemporaryFolder::RemoveAbandoned(const fs::path& parent) {
  std::error_code error;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end; entry.increment(error)) {
    if (!entry->path().filename().string().starts_with(kPrefix)) continue;
    const int lock = Lock(entry->path());
    if (lock < 0) continue;
    std::error_code ignored;
    fs::remove_all(entry->path(), ignored);
    ::close(lock);
  }
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})), lock_(std::exchange(other.lock_, -1)) {}

TemporaryFolder& TemporaryFolder::operator=(TemporaryFolder&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(lock_, other.lock_);
  return *this;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

}  // namespace etude
