#include "io/files/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <span>
#include <system_error>
#include <utility>

#include "engine/base/machine.h"

namespace etude {
namespace {

constexpr std::size_t kBufferBytes = 1 << 16;

Place InFile(const FilePath& path) { return Place{.file = path.string()}; }

/// Reads the next bytes of a file; returns the number of bytes, which is 0 at the end.
Result<std::size_t> ReadSome(const FilePath& path, int file, std::span<char> into) {
  ssize_t count = 0;
  do count = ::read(file, into.data(), into.size());
  while (count < 0 && errno == EINTR);
  if (count < 0) return CannotRead(path.string(), "cannot read this file", errno);
  return static_cast<std::size_t>(count);
}

/// Returns true if fsync succeeds, or if the file system does not support it (EINVAL, ENOTSUP).
bool Synced(int file) { return ::fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP; }

Result<void> Sync(const std::filesystem::path& path, int flags) {
  int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (file < 0 && errno == EACCES)
    file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags);  // read access may be denied for a lock file
  if (file < 0)
    return CannotWrite(path.string(), "the file cannot be opened for writing it to the disk (fsync)", errno);
  const int failed = Synced(file) ? 0 : errno;
  ::close(file);
  if (failed != 0) return CannotWrite(path.string(), "the file cannot be written to the disk (fsync)", failed);
  return {};
}

/// Returns the temporary name with the number `copy` + 1, which is left out if `copy` is 0. The name keeps the
/// extension, because encoders choose the container by the extension.
std::filesystem::path NameOfCopy(const std::filesystem::path& path, int copy) {
  const std::string number = copy == 0 ? "" : std::to_string(copy + 1);
  return path.parent_path() / (path.stem().string() + ".partial" + number + path.extension().string());
}

bool LockNamed(int file, int folder, const std::string& name) {
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  struct stat ours {
  }, there{};
  if (::fstat(file, &ours) != 0 || ::fstatat(folder, name.c_str(), &there, AT_SYMLINK_NOFOLLOW) != 0) return false;
  return ours.st_dev == there.st_dev && ours.st_ino == there.st_ino;
}

/// Returns true if the file has no second name (hard link); otherwise, writing would also change the file of the second
/// name.
bool HasOneName(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 1;
}

}  // namespace

std::filesystem::path TemporaryName(const std::filesystem::path& path) { return NameOfCopy(path, 0); }

Result<void> WriteFileAtomically(const FilePath& path, std::string_view bytes, OnDisk when) {
  ASSIGN_OR_RETURN(auto file, AtomicFile::Begin(path));
  RETURN_IF_ERROR(file.Write(bytes));
  return file.Finish(when);
}

Result<void> SaveJson(const FilePath& path, const Json& json, OnDisk when) {
  ASSIGN_OR_RETURN(const auto text, WriteJson(json));
  return WriteFileAtomically(path, text + "\n", when);
}

bool LockUnlessTaken(int file, const std::filesystem::path& name) { return LockNamed(file, AT_FDCWD, name.string()); }

Result<PartialFile> PartialFile::Claim(const FilePath& path) {
  PartialFile partial;
  partial.path_ = path;
  const std::filesystem::path folder = path.whole().parent_path();
  std::error_code ignored;
  partial.made_folder_ = !folder.empty() && !std::filesystem::exists(folder, ignored);
  ASSIGN_OR_RETURN(partial.spot_, FileSpot::Find(path, /*makes_folders=*/true));
  constexpr int kMaxTries = 1000;  // a try fails if another process is writing the file or has just renamed it
  constexpr int kFlags = O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  for (int copy = 0; copy < kMaxTries; ++copy) {
    partial.name_ = NameOfCopy(partial.spot_.name(), copy / 2).string();
    const int file = ::openat(partial.spot_.folder(), partial.name_.c_str(), kFlags, 0666);
    if (file < 0 && errno == ELOOP && path.is_inside()) return RefuseLink(folder / partial.name_);
    if (file < 0) return partial.Failure();
    if (!HasOneName(file) || !LockNamed(file, partial.spot_.folder(), partial.name_)) {
      ::close(file);
      continue;
    }
    partial.file_ = file;
    if (::ftruncate(file, 0) != 0) return partial.Failure();
    return partial;
  }
  return Fail(InFile(path), "cannot write this file: too many processes write it at the same time");
}

PartialFile& PartialFile::operator=(PartialFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(spot_, other.spot_);
  std::swap(name_, other.name_);
  std::swap(file_, other.file_);
  std::swap(made_folder_, other.made_folder_);
  return *this;
}

PartialFile::~PartialFile() {
  if (file_ < 0) return;
  ::unlinkat(spot_.folder(), name_.c_str(), 0);
  ::close(file_);  // last, because closing releases the lock
}

tl::unexpected<Error> PartialFile::Failure() const {
  return CannotWrite(path_.string(), "cannot write this file", errno);
}

Result<void> PartialFile::CheckRoom() const {
  const std::array<char, kBufferBytes> more{};
  const off_t end = ::lseek(file_, 0, SEEK_END);
  const ssize_t count = ::pwrite(file_, more.data(), more.size(), end);
  if (count == static_cast<ssize_t>(more.size())) return {};
  // A partial write sets no errno, but a second write does.
  if (count >= 0 && ::pwrite(file_, more.data(), more.size(), end + count) >= 0) return {};
  return Failure();
}

Result<void> PartialFile::Finish(OnDisk when) {
  // fsync reports failed writes; without it, some file systems (NFS) report failed writes when a descriptor is closed.
  if (when == OnDisk::kAtOnce ? !Synced(file_) : ::close(::dup(file_)) != 0) return Failure();
  const int folder = spot_.folder();
  if (::renameat(folder, name_.c_str(), folder, spot_.name().c_str()) != 0) return Failure();
  ::close(std::exchange(file_, -1));
  if (when == OnDisk::kLater) return {};
  const std::filesystem::path above = path_.whole().parent_path();
  if (::access(above.empty() ? "." : above.c_str(), R_OK) == 0) RETURN_IF_ERROR(SyncFolder(above));
  return made_folder_ ? SyncPathTo(above) : Result<void>();
}

Result<AtomicFile> AtomicFile::Begin(const FilePath& path) {
  AtomicFile file;
  ASSIGN_OR_RETURN(file.partial_, PartialFile::Claim(path));
  return file;
}

Result<void> AtomicFile::Write(std::string_view bytes) {
  unwritten_ += bytes;
  return unwritten_.size() >= kBufferBytes ? Flush() : Result<void>();
}

Result<void> AtomicFile::Flush() {
  for (std::size_t written = 0; written < unwritten_.size();) {
    const ssize_t count = ::write(partial_.file(), unwritten_.data() + written, unwritten_.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return partial_.Failure();
    written += static_cast<std::size_t>(count);
  }
  unwritten_.clear();
  return {};
}

Result<void> AtomicFile::Overwrite(std::uint64_t offset, std::string_view bytes) {
  RETURN_IF_ERROR(Flush());
  const ssize_t count = ::pwrite(partial_.file(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
  return count == static_cast<ssize_t>(bytes.size()) ? Result<void>() : partial_.Failure();
}

Result<void> AtomicFile::Finish(OnDisk when) {
  RETURN_IF_ERROR(Flush());
  return partial_.Finish(when);
}

Result<void> ReadInChunks(const FilePath& path, const std::function<void(std::string_view)>& use) {
  ASSIGN_OR_RETURN(const auto file, OpenFile(path, O_RDONLY));
  std::string chunk(std::size_t{1} << 18, '\0');
  while (true) {
    ASSIGN_OR_RETURN(const std::size_t size, ReadSome(path, file.number(), chunk));
    if (size == 0) return {};
    use(std::string_view(chunk).substr(0, size));
  }
}

Result<FileLines> FileLines::Open(const FilePath& path) {
  ASSIGN_OR_RETURN(auto file, OpenFile(path, O_RDONLY));
  return FileLines(path, std::move(file));
}

Result<bool> FileLines::Next(std::string& line) {
  line.clear();
  had_end_ = false;
  while (true) {
    const std::size_t end = part_.find('\n', at_);
    line.append(part_, at_, end == std::string::npos ? end : end - at_);
    if (end != std::string::npos) {
      at_ = end + 1;
      had_end_ = true;
      return true;
    }
    part_.resize(kBufferBytes);
    at_ = 0;
    const auto size = ReadSome(path_, file_.number(), part_);
    part_.resize(size.value_or(0));
    if (!size) return tl::unexpected(size.error());
    if (*size == 0) return !line.empty();
  }
}

Result<void> ForEachLine(const FilePath& path, const std::function<Result<void>(std::string_view, const Place&)>& use) {
  ASSIGN_OR_RETURN(auto lines, FileLines::Open(path));
  Place place{.file = path.string(), .line = 1};
  for (std::string line;; ++place.line) {
    ASSIGN_OR_RETURN(const bool has_line, lines.Next(line));
    if (!has_line) return {};
    RETURN_IF_ERROR(use(line, place));
  }
}

Result<std::string> ReadWholeFile(const FilePath& path, std::uintmax_t limit) {
  ASSIGN_OR_RETURN(const auto file, OpenFile(path, O_RDONLY));
  struct stat status {};
  const std::uintmax_t size =
      ::fstat(file.number(), &status) == 0 ? static_cast<std::uintmax_t>(status.st_size) : std::uintmax_t{0};
  if (size > limit) return Fail(InFile(path), "found {} MiB; allowed: at most {} MiB", size >> 20, limit >> 20);
  std::string bytes;
  bytes.reserve(size);
  std::array<char, 1 << 16> chunk{};
  while (true) {
    ASSIGN_OR_RETURN(const std::size_t count, ReadSome(path, file.number(), chunk));
    if (count == 0) return bytes;
    bytes.append(chunk.data(), count);
    if (bytes.size() > limit) return Fail(InFile(path), "the file became larger while Etude read it");
  }
}

Result<void> SyncFile(const std::filesystem::path& path) { return Sync(path, 0); }

Result<void> SyncFolder(const std::filesystem::path& folder) {
  return Sync(folder.empty() ? "." : folder, O_DIRECTORY);
}

Result<void> SyncPathTo(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path above = std::filesystem::absolute(folder, error).lexically_normal();
  if (error) return Fail({folder.string()}, "cannot be found: {}", error.message());
  while (above.has_relative_path()) {
    above = above.parent_path();
    if (::access(above.c_str(), R_OK) == 0) RETURN_IF_ERROR(SyncFolder(above));
  }
  return {};
}

Result<void> SyncTree(const std::filesystem::path& folder) {
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto status = entry->symlink_status(error);
    if (std::filesystem::is_directory(status)) {
      RETURN_IF_ERROR(SyncFolder(entry->path()));
    } else if (std::filesystem::is_regular_file(status)) {
      RETURN_IF_ERROR(SyncFile(entry->path()));
    }
  }
  if (error) return CannotRead(folder.string(), "cannot be read", error.value());
  return SyncFolder(folder);
}

}  // namespace etude
