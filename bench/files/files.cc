#include "bench/files/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "engine/base/machine.h"

namespace etude {
namespace {

constexpr std::size_t kBuffer = 1 << 16;

Place InFile(const std::filesystem::path& path) { return Place{.file = path.string()}; }

Result<void> CheckReadable(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return Fail(InFile(path), "no such file");
  if (!std::filesystem::exists(status)) return CannotRead(path.string(), "cannot read this file", error.value());
  if (!std::filesystem::is_regular_file(status)) return Fail(InFile(path), "is no file");
  return {};
}

/// Some file systems have nothing to synchronise and say so.
bool Synced(int file) { return ::fsync(file) == 0 || errno == EINVAL || errno == ENOTSUP; }

Result<void> Sync(const std::filesystem::path& path, int flags) {
  int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (file < 0 && errno == EACCES) file = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | flags);  // such as a lock
  if (file < 0) return CannotWrite(path.string(), "cannot be opened to synchronise it", errno);
  const int failed = Synced(file) ? 0 : errno;
  ::close(file);
  if (failed != 0) return CannotWrite(path.string(), "cannot be synchronised", failed);
  return {};
}

/// The extension stays last: encoders choose the container by it.
std::filesystem::path NameOfCopy(const std::filesystem::path& path, int copy) {
  const std::string number = copy == 0 ? "" : std::to_string(copy + 1);
  return path.parent_path() / (path.stem().string() + ".partial" + number + path.extension().string());
}

}  // namespace

std::filesystem::path TemporaryName(const std::filesystem::path& path) { return NameOfCopy(path, 0); }

Result<void> MakeFolder(const std::filesystem::path& folder) {
  if (folder.empty()) return {};  // of a plain file name: the one we stand in
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return CannotWrite(folder.string(), "cannot make this folder", error.value());
  return {};
}

Result<void> WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes, OnDisk when) {
  ASSIGN_OR_RETURN(auto file, AtomicFile::Begin(path));
  RETURN_IF_ERROR(file.Write(bytes));
  return file.Finish(when);
}

Result<void> SaveJson(const std::filesystem::path& path, const Json& json, OnDisk when) {
  ASSIGN_OR_RETURN(const auto text, WriteJson(json));
  return WriteFileAtomically(path, text + "\n", when);
}

bool LockUnlessTaken(int file, const std::filesystem::path& name) {
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  struct stat ours {
  }, there{};
  if (::fstat(file, &ours) != 0 || ::lstat(name.c_str(), &there) != 0) return false;
  return ours.st_dev == there.st_dev && ours.st_ino == there.st_ino;
}

Result<PartialFile> PartialFile::Claim(const std::filesystem::path& path) {
  PartialFile partial;
  partial.path_ = path;
  std::error_code ignored;
  partial.made_folder_ = !path.parent_path().empty() && !std::filesystem::exists(path.parent_path(), ignored);
  RETURN_IF_ERROR(MakeFolder(path.parent_path()));
  constexpr int kMostTries = 1000;  // a try fails where another process writes the same file, or has just finished it
  for (int copy = 0; copy < kMostTries; ++copy) {
    partial.name_ = NameOfCopy(path, copy / 2);
    const int file = ::open(partial.name_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file < 0) return partial.Failure();
    if (!LockUnlessTaken(file, partial.name_)) {
      ::close(file);
      continue;
    }
    partial.file_ = file;
    if (::ftruncate(file, 0) != 0) return partial.Failure();
    return partial;
  }
  return Fail(InFile(path), "cannot write this file: too many processes do");
}

PartialFile& PartialFile::operator=(PartialFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(name_, other.name_);
  std::swap(file_, other.file_);
  std::swap(made_folder_, other.made_folder_);
  return *this;
}

PartialFile::~PartialFile() {
  if (file_ < 0) return;
  std::error_code ignored;
  std::filesystem::remove(name_, ignored);
  ::close(file_);  // last: until then nobody else takes the name
}

tl::unexpected<Error> PartialFile::Failure() const {
  return CannotWrite(path_.string(), "cannot write this file", errno);
}

Result<void> PartialFile::CheckRoom() const {
  const std::array<char, kBuffer> more{};
  const off_t end = ::lseek(file_, 0, SEEK_END);
  const ssize_t count = ::pwrite(file_, more.data(), more.size(), end);
  if (count == static_cast<ssize_t>(more.size())) return {};
  // What was taken in part says the reason when the rest is tried.
  if (count >= 0 && ::pwrite(file_, more.data(), more.size(), end + count) >= 0) return {};
  return Failure();
}

Result<void> PartialFile::Finish(OnDisk when) {
  // What cannot be written is told by fsync, or else, on some file systems, when a descriptor of the file is closed.
  if (when == OnDisk::kAtOnce ? !Synced(file_) : ::close(::dup(file_)) != 0) return Failure();
  if (::rename(name_.c_str(), path_.c_str()) != 0) return Failure();
  ::close(std::exchange(file_, -1));
  if (when == OnDisk::kLater) return {};
  const std::filesystem::path folder = path_.parent_path();
  if (::access(folder.empty() ? "." : folder.c_str(), R_OK) == 0) RETURN_IF_ERROR(SyncFolder(folder));
  return made_folder_ ? SyncPathTo(folder) : Result<void>();
}

Result<AtomicFile> AtomicFile::Begin(const std::filesystem::path& path) {
  AtomicFile file;
  ASSIGN_OR_RETURN(file.partial_, PartialFile::Claim(path));
  return file;
}

Result<void> AtomicFile::Write(std::string_view bytes) {
  unwritten_ += bytes;
  return unwritten_.size() >= kBuffer ? Flush() : Result<void>();
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

Result<void> ReadInChunks(const std::filesystem::path& path, const std::function<void(std::string_view)>& use) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return CannotRead(path.string(), "cannot read this file", errno);
  std::vector<char> chunk(1 << 18);
  while (in.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || in.gcount() > 0) {
    use({chunk.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (in.bad()) return CannotRead(path.string(), "cannot read this file", errno);
  return {};
}

Result<void> ForEachLine(const std::filesystem::path& path,
                         const std::function<Result<void>(std::string_view, const Place&)>& use) {
  RETURN_IF_ERROR(CheckReadable(path));
  std::ifstream in(path, std::ios::binary);
  if (!in) return CannotRead(path.string(), "cannot read this file", errno);
  Place place{.file = path.string(), .line = 1};
  for (std::string line; std::getline(in, line); ++place.line) RETURN_IF_ERROR(use(line, place));
  if (in.bad()) return CannotRead(path.string(), "cannot read this file", errno);
  return {};
}

Result<std::string> ReadWholeFile(const std::filesystem::path& path) {
  RETURN_IF_ERROR(CheckReadable(path));
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > kLargestFile) {
    return Fail(InFile(path), "{} MiB; at most {} MiB are read", size >> 20, kLargestFile >> 20);
  }
  std::ifstream in(path, std::ios::binary);
  if (!in) return CannotRead(path.string(), "cannot read this file", errno);
  std::string bytes;
  bytes.reserve(error ? 0 : size);
  std::array<char, 1 << 16> chunk{};
  while (in.read(chunk.data(), chunk.size()) || in.gcount() > 0) {
    bytes.append(chunk.data(), static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > kLargestFile) return Fail(InFile(path), "grows while it is read");
  }
  if (in.bad()) return CannotRead(path.string(), "cannot read this file", errno);
  return bytes;
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
