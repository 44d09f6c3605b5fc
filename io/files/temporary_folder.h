#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// A folder of our own, in the system's place for temporary files unless told another, removed with all in it at the
/// end; after a kill, by the next process that makes one there.
class TemporaryFolder {
 public:
  /// `purpose` becomes part of its name.
  static Result<TemporaryFolder> Make(const std::string& purpose);
  /// Makes it in a folder of the caller's choice, such as one of the file system that something is to be renamed in.
  static Result<TemporaryFolder> MakeIn(const std::filesystem::path& parent, const std::string& purpose);
  /// Makes one in whose name `kept` stands; it is no longer removed when its process has been killed, but found again.
  static Result<TemporaryFolder> MakeKept(const std::filesystem::path& parent, const std::string& kept);
  /// Takes over those of this name whose processes have been killed.
  static std::vector<TemporaryFolder> FindKept(const std::filesystem::path& parent, const std::string& kept);
  /// Removes those whose processes have been killed, of a folder or of the system's place. Make does it, too.
  static void RemoveAbandoned(const std::filesystem::path& parent);
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
