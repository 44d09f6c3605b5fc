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

/// The path of a file or folder. A path that a person gave is used as the system does it, links and all. What stands in
/// a folder that somebody else may have filled (a run, a shard, answers) is `Inside(folder) / "name"`: no link below
/// that folder is followed, and no name leads out of it.
class FilePath {
 public:
  /// A path that a person gave.
  template <typename Text>
  requires(!std::same_as<std::remove_cvref_t<Text>, FilePath> && std::constructible_from<std::filesystem::path, Text>)
      FilePath(Text&& path)
      : given_(std::forward<Text>(path)) {}  // NOLINT(google-explicit-constructor)

  FilePath operator/(const std::filesystem::path& name) const;

  std::filesystem::path whole() const { return below_.empty() ? given_ : given_ / below_; }
  std::string string() const { return whole().string(); }
  bool is_inside() const { return is_inside_; }
  /// Of a path inside a folder: that folder, as a person gave it; else the whole path.
  const std::filesystem::path& given() const { return given_; }
  /// Of a path inside a folder: the part below it; else empty.
  const std::filesystem::path& below() const { return below_; }

 private:
  friend FilePath Inside(const std::filesystem::path& folder);

  std::filesystem::path given_, below_;
  bool is_inside_ = false;
};

/// A folder that a person gave and somebody else may have filled; it may be a link itself.
FilePath Inside(const std::filesystem::path& folder);

/// A name, and the folder that it is looked up in.
class FileSpot {
 public:
  /// Opens the folders of `path` one by one, and with `makes_folders` makes those that are missing. Fails naming a link
  /// that would have to be followed, a path that leads out of its folder, or the system's reason.
  static Result<FileSpot> Find(const FilePath& path, bool makes_folders);

  /// For the system's calls that end in …at.
  int folder() const;
  /// The name in that folder; of a path that a person gave, all of it.
  const std::string& name() const { return name_; }

 private:
  Descriptor folder_;  ///< none: the one we stand in
  std::string name_;
};

/// Opens a regular file as ::open does (O_CLOEXEC is added); with O_CREAT it makes the folders above it, too. Fails as
/// FileSpot::Find does; on whatever is no regular file, so that nobody waits for a pipe; and with the system's reason.
Result<Descriptor> OpenFile(const FilePath& path, int flags, mode_t mode = 0666);

/// True if something stands there: also a link that is not followed and will be refused by whoever opens it.
bool Exists(const FilePath& path);

/// Makes a folder and those above it. Fails as FileSpot::Find does.
Result<void> MakeFolder(const FilePath& folder);

/// Lists the files in a folder and in all folders below by their paths from it, ascending; none where there is no
/// folder. Fails naming the first link, pipe or device.
Result<std::vector<std::filesystem::path>> PlainFilesBelow(const FilePath& folder);

/// Says that a link is not followed.
tl::unexpected<Error> RefuseLink(const std::filesystem::path& link);

}  // namespace etude
