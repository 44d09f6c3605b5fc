#include "bench/files/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace etude {

namespace fs = std::filesystem;

Result<TemporaryFolder> TemporaryFolder::Make(const std::string& purpose) {
  std::error_code error;
  const fs::path parent = fs::temp_directory_path(error);
  if (error) return Fail({parent.string(), 0, 0}, "is no folder for temporary files: {}", error.message());
  std::string name = (parent / ("etude-" + purpose + "-XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr) return Fail({name, 0, 0}, "cannot be made: {}", std::strerror(errno));
  return TemporaryFolder(name);
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}

TemporaryFolder& TemporaryFolder::operator=(TemporaryFolder&& other) noexcept {
  std::swap(path_, other.path_);
  return *this;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

}  // namespace etude
