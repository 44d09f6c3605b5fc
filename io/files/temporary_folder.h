#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// A temporary folder, deleted with its contents by the destructor. If the process is killed, the next process that
/// makes a temporary folder in the same parent folder deletes the folder of the killed process.
class TemporaryFolder {
 public:
  /// Makes a temporary folder in $TMPDIR, else in /tmp. `purpose` becomes part of its name.
  static Result<TemporaryFolder> Make(const std::string& purpose);
  /// Makes a temporary folder in `parent`: for files that will be renamed, because renaming works only within one file
  /// system.
  static Result<TemporaryFolder> MakeIn(const std::filesystem::path& parent, const std::string& purpose);
  /// Makes a temporary folder that stays if the process is killed; FindKept finds it by `kept`, a part of its name.
  static Result<TemporaryFolder> MakeKept(const std::filesystem::path& parent, const std::string& kept);
  /// Takes over all folders that MakeKept made with the name `kept` in processes that have been killed.
  static std::vector<TemporaryFolder> FindKept(const std::filesystem::path& parent, const std::string& kept);
  /// Deletes the folders in `parent` (default: the system's temporary folder) whose processes have been killed. Make
  /// and MakeIn do this too.
  static void RemoveAbandoned(const std::filesystem::path& parent);
  static void RemoveAbandoned();
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&& other) noexcept;
  ~TemporaryFolder();

  const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryFolder(std::filesystem::path path, int lock) : path_(std::move(path)), lock_(lock) {}

  std::filesystem::path path_;
  int lock_ = -1;  ///< descriptor of the locked folder; the lock tells other processes that the folder is in use
};

}  // namespace etude
