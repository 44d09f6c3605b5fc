#include "bench/files/durable.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace etude {
namespace {

namespace fs = std::filesystem;

Result<void> Sync(const fs::path& path, int flags) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (file < 0) return Fail({path.string()}, "cannot be opened to synchronise it: {}", std::strerror(errno));
  const int failed = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  // Some file systems have nothing to synchronise and say so.
  if (failed != 0 && failed != EINVAL && failed != ENOTSUP) {
    return Fail({path.string()}, "cannot be synchronised: {}", std::strerror(failed));
  }
  return {};
}

}  // namespace

Result<void> SyncFile(const fs::path& path) { return Sync(path, 0); }

Result<void> SyncFolder(const fs::path& folder) { return Sync(folder.empty() ? "." : folder, O_DIRECTORY); }

Result<void> SyncPathTo(const fs::path& folder) {
  std::error_code error;
  fs::path above = fs::absolute(folder, error).lexically_normal();
  if (error) return Fail({folder.string()}, "cannot be found: {}", error.message());
  while (above.has_relative_path()) {
    above = above.parent_path();
    if (::access(above.c_str(), R_OK) == 0) RETURN_IF_ERROR(SyncFolder(above));
  }
  return {};
}

Result<void> SyncTree(const fs::path& folder) {
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const auto status = entry->symlink_status(error);
    if (fs::is_directory(status)) {
      RETURN_IF_ERROR(SyncFolder(entry->path()));
    } else if (fs::is_regular_file(status)) {
      RETURN_IF_ERROR(SyncFile(entry->path()));
    }
  }
  if (error) return Fail({folder.string()}, "cannot be read: {}", error.message());
  return SyncFolder(folder);
}

}  // namespace etude
