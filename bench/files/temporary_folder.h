#pragma once

#include <filesystem>
#include <string>

#include "engine/base/result.h"

namespace etude {

/// A folder of our own in the system's place for temporary files, removed with all in it at the end.
class TemporaryFolder {
 public:
  /// `purpose` becomes part of its name.
  static Result<TemporaryFolder> Make(const std::string& purpose);
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  explicit TemporaryFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;
};

}  // namespace etude
