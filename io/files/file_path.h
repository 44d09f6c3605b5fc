#pragma once

#include <sys/types.h>

#include <concepts>
#include <filesystem>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "io/files/descriptor.h"

namespace etude {

/// The path of a file or folder. There are two kinds. In a path that the user gave, symbolic links are followed. But a
/// file in a folder that somebody else may have filled (a run, a shard, answers) has the path `Inside(folder) /
/// "name"`: no link below that folder is followed, and no name may lead out of the folder.
class FilePath {
 public:
  /// A path that the user gave.
  template <typename Text>
  requires(!std::same_as<std::remove_cvref_t<Text>, FilePath> && std::constructible_from<std::filesystem::path, Text>)
      FilePath(Text&& path)
      : given_(std::forward<Text>(path)) {}  // NOLINT(google-explicit-constructor)

  FilePath operator/(const std::filesystem::path& name) const;

  std::filesystem::path whole() const { return below_.empty() ? given_ : given_ / below_; }
  std::string string() const { return whole().string(); }
  bool is_inside() const { return is_inside_; }
  /// Returns the folder of an `Inside` path, as the user gave it; for other paths the whole path.
  const std::filesystem::path& given() const { return given_; }
  /// Returns the part of an `Inside` path below the path's folder; "" for other paths.
  const std::filesystem::path& below() const { return below_; }

 private:
  friend FilePath Inside(const std::filesystem::path& folder);

  std::filesystem::path given_, below_;
  bool is_inside_ = false;
};

/// Returns true if `path` is the folder or lies in it. Both are normalised, and both absolute or both relative.
bool IsWithin(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Marks a folder that the user gave and somebody else may have filled. The folder itself may be a link.
FilePath Inside(const std::filesystem::path& folder);

/// An open folder and the name of a file in this folder: the arguments of the system calls whose names end in "at"
/// (openat, renameat).
class FileSpot {
 public:
  /// Opens the folders of an `Inside` path one by one; `makes_folders` creates missing folders. Fails if a folder is a
  /// link, if the path leads out of the `Inside` folder, or if a folder cannot be opened (with the system's reason).
  static Result<FileSpot> Find(const FilePath& path, bool makes_folders);

  int folder() const;
  /// Returns the file's name in the open folder; for a path that the user gave, the whole path.
  const std::string& name() const { return name_; }

 private:
  Descriptor folder_;  ///< the open folder; none = the working folder
  std::string name_;
};

/// Opens a regular file with the flags of ::open (O_CLOEXEC is added); O_CREAT also creates the file's folders. Fails
/// as FileSpot::Find does. Also fails if the path is not a regular file (opening a pipe could block), or, with the
/// system's reason, if the file cannot be opened.
Result<Descriptor> OpenFile(const FilePath& path, int flags, mode_t mode = 0666);

/// Returns true if a file, a folder or a link has this path. A link below an `Inside` folder counts, although OpenFile
/// refuses such a link.
bool Exists(const FilePath& path);

/// Removes a file, or a link itself; does nothing if the path does not exist. Fails as FileSpot::Find does, and, with
/// the system's reason, if the file cannot be removed.
Result<void> RemoveFile(const FilePath& path);

/// Creates a folder and all missing folders above it. Fails as FileSpot::Find does.
Result<void> MakeFolder(const FilePath& folder);

/// Lists the paths of all regular files below a folder, relative to this folder and sorted; empty if the folder does
/// not exist. Fails on the first link, pipe or device.
Result<std::vector<std::filesystem::path>> PlainFilesBelow(const FilePath& folder);

/// Returns the error "is a link; links inside this folder are not followed".
tl::unexpected<Error> RefuseLink(const std::filesystem::path& link);

}  // namespace etude
