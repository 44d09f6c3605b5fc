#include "io/files/file_path.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "engine/base/machine.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kFolderMode = 0777;  // permissions of a new folder, before the umask is applied

bool IsLink(int folder, const std::string& name) {
  struct stat status {};
  return ::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISLNK(status.st_mode);
}

/// Opens the folder `name` in `folder`, but never through a link. With `makes`, creates a missing folder. Returns −1 if
/// the folder cannot be opened.
int OpenNext(int folder, const std::string& name, bool makes) {
  constexpr int kFlags = O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
  const int next = ::openat(folder, name.c_str(), kFlags);
  if (next >= 0 || errno != ENOENT || !makes) return next;
  if (::mkdirat(folder, name.c_str(), kFolderMode) != 0 && errno != EEXIST) return -1;
  return ::openat(folder, name.c_str(), kFlags);
}

/// The result of WalkDown, which opens the folder `given` and then, one inside the other, the folders of the relative
/// path `below`.
struct Walk {
  Descriptor end;            ///< the last folder; none on failure
  fs::path stopped_at = {};  ///< the folder that could not be opened
  /// The errno of the failure; ELOOP = the folder is a link, EXDEV = the path leads out of `given`.
  int reason = 0;
};

Walk WalkDown(const fs::path& given, const fs::path& below, bool makes) {
  const fs::path start = given.empty() ? "." : given;
  Walk walk{Descriptor(::open(start.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC))};
  if (walk.end.number() < 0) return {Descriptor(), start, errno};
  fs::path at = given;
  for (const fs::path& part : below) {
    at /= part;
    if (part.empty() || part == ".") continue;
    if (part == ".." || part.is_absolute()) return {Descriptor(), given / below, EXDEV};
    const int next = OpenNext(walk.end.number(), part.string(), makes);
    if (next < 0) {
      const int reason = errno;
      return {Descriptor(), at, IsLink(walk.end.number(), part.string()) ? ELOOP : reason};
    }
    walk.end = Descriptor(next);
  }
  return walk;
}

tl::unexpected<Error> WhyNot(const Walk& walk, const FilePath& path, bool makes) {
  if (walk.reason == ELOOP) return RefuseLink(walk.stopped_at);
  if (walk.reason == EXDEV) return Fail({path.string()}, "leads out of '{}'", path.given().string());
  if (makes) return CannotWrite(walk.stopped_at.string(), "cannot make this folder", walk.reason);
  if (walk.reason == ENOENT) return Fail({path.string()}, "no such file");
  return CannotRead(walk.stopped_at.string(), "cannot be opened", walk.reason);
}

tl::unexpected<Error> RefuseFolder(const FilePath& path) {
  return Fail({path.string()}, "is no file, but a folder; allowed: a file");
}

Result<void> MakeGiven(const fs::path& folder) {
  if (folder.empty()) return {};  // the path names a file in the working folder
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return CannotWrite(folder.string(), "cannot make this folder", error.value());
  return {};
}

}  // namespace

FilePath FilePath::operator/(const fs::path& name) const {
  FilePath path = *this;
  (is_inside_ ? path.below_ : path.given_) /= name;
  return path;
}

bool IsWithin(const fs::path& path, const fs::path& folder) {
  return std::ranges::mismatch(folder, path).in1 == folder.end();
}

FilePath Inside(const fs::path& folder) {
  FilePath path(folder);
  path.is_inside_ = true;
  return path;
}

Result<FileSpot> FileSpot::Find(const FilePath& path, bool makes_folders) {
  FileSpot spot;
  if (makes_folders) RETURN_IF_ERROR(MakeGiven(path.is_inside() ? path.given() : path.given().parent_path()));
  if (!path.is_inside()) {
    spot.name_ = path.string();
    return spot;
  }
  spot.name_ = path.below().filename().string();
  Walk walk = WalkDown(path.given(), path.below().parent_path(), makes_folders);
  if (walk.end.number() < 0) return WhyNot(walk, path, makes_folders);
  if (spot.name_.empty() || spot.name_ == "." || spot.name_ == "..") {
    return Fail({path.string()}, "this path does not end with the name of a file");
  }
  spot.folder_ = std::move(walk.end);
  return spot;
}

int FileSpot::folder() const { return folder_.number() < 0 ? AT_FDCWD : folder_.number(); }

Result<Descriptor> OpenFile(const FilePath& path, int flags, mode_t mode) {
  ASSIGN_OR_RETURN(const auto spot, FileSpot::Find(path, (flags & O_CREAT) != 0));
  // Without O_NONBLOCK, opening a pipe would block. The flag has no effect on a regular file.
  const int more = O_CLOEXEC | O_NONBLOCK | O_NOCTTY | (path.is_inside() ? O_NOFOLLOW : 0);
  // The file is truncated below, after the checks.
  Descriptor file(::openat(spot.folder(), spot.name().c_str(), (flags & ~O_TRUNC) | more, mode));
  if (file.number() < 0) {
    const int reason = errno;
    if (path.is_inside() && IsLink(spot.folder(), spot.name())) return RefuseLink(path.whole());
    if (reason == ENOENT) return Fail({path.string()}, "no such file");
    if (reason == EISDIR) return RefuseFolder(path);
    if (reason == ENXIO) return Fail({path.string()}, "is no file");
    return (flags & O_ACCMODE) == O_RDONLY ? CannotRead(path.string(), "cannot read this file", reason)
                                           : CannotWrite(path.string(), "cannot write this file", reason);
  }
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) return Fail({path.string()}, "is no file");
  if (S_ISDIR(status.st_mode)) return RefuseFolder(path);
  if (!S_ISREG(status.st_mode)) return Fail({path.string()}, "is no file");
  if (path.is_inside() && (flags & O_ACCMODE) != O_RDONLY && status.st_nlink > 1) {
    return Fail({path.string()},
                "the file has a second name (a hard link), and writing would also change the file of the second name");
  }
  if ((flags & O_TRUNC) != 0 && ::ftruncate(file.number(), 0) != 0) {
    return CannotWrite(path.string(), "cannot write this file", errno);
  }
  return file;
}

bool Exists(const FilePath& path) {
  std::error_code none;
  if (!path.is_inside() || path.below().empty()) return fs::exists(path.whole(), none);
  const Walk walk = WalkDown(path.given(), path.below().parent_path(), /*makes=*/false);
  if (walk.end.number() < 0) return walk.reason == ELOOP || walk.reason == EXDEV;
  struct stat status {};
  return ::fstatat(walk.end.number(), path.below().filename().c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0;
}

Result<void> RemoveFile(const FilePath& path) {
  if (!Exists(path)) return {};
  ASSIGN_OR_RETURN(const auto spot, FileSpot::Find(path, /*makes_folders=*/false));
  if (::unlinkat(spot.folder(), spot.name().c_str(), 0) == 0 || errno == ENOENT) return {};
  return CannotWrite(path.string(), "cannot remove this file", errno);
}

Result<void> MakeFolder(const FilePath& folder) {
  RETURN_IF_ERROR(MakeGiven(folder.given()));
  const Walk walk = WalkDown(folder.given(), folder.below(), /*makes=*/true);
  return walk.end.number() < 0 ? Result<void>(WhyNot(walk, folder, /*makes=*/true)) : Result<void>();
}

Result<std::vector<fs::path>> PlainFilesBelow(const FilePath& folder) {
  std::vector<fs::path> files;
  const Walk walk = WalkDown(folder.given(), folder.below(), /*makes=*/false);
  if (walk.end.number() < 0 && walk.reason == ENOENT) return files;
  if (walk.end.number() < 0) return WhyNot(walk, folder, /*makes=*/false);
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder.whole(), error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::file_status status = entry->symlink_status(error);
    if (fs::is_directory(status)) continue;
    if (fs::is_symlink(status)) return RefuseLink(entry->path());
    if (!fs::is_regular_file(status)) return Fail({entry->path().string()}, "this is neither a file nor a folder");
    files.push_back(entry->path().lexically_relative(folder.whole()));
  }
  if (error) return CannotRead(folder.string(), "cannot be read", error.value());
  std::sort(files.begin(), files.end());
  return files;
}

tl::unexpected<Error> RefuseLink(const fs::path& link) {
  return Fail({link.string()}, "this is a link, and Etude does not follow links inside this folder");
}

}  // namespace etude
