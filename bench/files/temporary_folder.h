#pragma once

#include <filesystem>
#include <string>

#include "engine/base/result.h"

namespace etude {

/// A folder of our own in the system's place for temporary files, removed with all in it at the end; after a kill, by
/// the next process that makes one.
class TemporaryFolder {
 public:
  /// `purpose` becomes part of its name.
  static Result<TemporaryFolder> Make(const std::string& purpose);
  /// Removes those whose processes have been killed. Make does it, too.
  static void RemoveAbandoned();
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryFolder(std::filesystem::path path, int lock) : path_(std::move(path)), lock_(lock) {}

  std::filesystem::path path_;
  int lock_ = -1;  ///< held while we live, so that it is seen to be in use
};

}  // namespace etude
