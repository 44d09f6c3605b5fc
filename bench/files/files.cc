#include "bench/files/files.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

namespace etude {
namespace {

constexpr std::size_t kBuffer = 1 << 16;

Place InFile(const std::filesystem::path& path) { return Place{.file = path.string()}; }

Result<void> CheckReadable(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    const bool absent = status.type() == std::filesystem::file_type::not_found;
    return Fail(InFile(path), "{}", absent ? "no such file" : "cannot read this file: " + error.message());
  }
  if (!std::filesystem::is_regular_file(status)) return Fail(InFile(path), "is no file");
  return {};
}

Result<void> Sync(const std::filesystem::path& path, int flags) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | flags);
  if (file < 0) return Fail({path.string()}, "cannot be opened to synchronise it: {}", std::strerror(errno));
  const int failed = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  // Some file systems have nothing to synchronise and say so.
  if (failed != 0 && failed != EINVAL && failed != ENOTSUP) {
    return Fail({path.string()}, "cannot be synchronised: {}", std::strerror(failed));
  }
  return {};
}

}  // namespace

std::filesystem::path TemporaryName(const std::filesystem::path& path) {
  // The extension stays last: encoders choose the container by it.
  return path.parent_path() / (path.stem().string() + ".partial" + path.extension().string());
}

Result<void> MakeFolder(const std::filesystem::path& folder) {
  if (folder.empty()) return {};  // of a plain file name: the one we stand in
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return Fail(InFile(folder), "cannot make this folder: {}", error.message());
  return {};
}

Result<void> RenameFinished(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  std::error_code error;
  std::filesystem::rename(temporary, path, error);
  if (!error) return {};
  std::error_code ignored;
  std::filesystem::remove(temporary, ignored);
  return Fail(InFile(path), "cannot write this file: {}", error.message());
}

Result<void> WriteFileAtomically(const std::filesystem::path& path, std::string_view bytes) {
  ASSIGN_OR_RETURN(auto file, AtomicFile::Begin(path));
  RETURN_IF_ERROR(file.Write(bytes));
  return file.Finish();
}

Result<void> SaveJson(const std::filesystem::path& path, const Json& json) {
  ASSIGN_OR_RETURN(const auto text, WriteJson(json));
  return WriteFileAtomically(path, text + "\n");
}

Result<AtomicFile> AtomicFile::Begin(const std::filesystem::path& path) {
  RETURN_IF_ERROR(MakeFolder(path.parent_path()));
  AtomicFile file(path, ::open(TemporaryName(path).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (file.file_ < 0) return file.Failure();
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept { *this = std::move(other); }

AtomicFile& AtomicFile::operator=(AtomicFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(file_, other.file_);
  std::swap(unwritten_, other.unwritten_);
  return *this;
}

AtomicFile::~AtomicFile() {
  if (file_ < 0) return;
  ::close(file_);
  std::error_code ignored;
  std::filesystem::remove(TemporaryName(path_), ignored);
}

tl::unexpected<Error> AtomicFile::Failure() {
  return Fail({path_.string()}, "cannot write this file: {}", std::strerror(errno));
}

Result<void> AtomicFile::Write(std::string_view bytes) {
  unwritten_ += bytes;
  return unwritten_.size() >= kBuffer ? Flush() : Result<void>();
}

Result<void> AtomicFile::Flush() {
  for (std::size_t written = 0; written < unwritten_.size();) {
    const ssize_t count = ::write(file_, unwritten_.data() + written, unwritten_.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return Failure();
    written += static_cast<std::size_t>(count);
  }
  unwritten_.clear();
  return {};
}

Result<void> AtomicFile::Overwrite(std::uint64_t offset, std::string_view bytes) {
  RETURN_IF_ERROR(Flush());
  if (::pwrite(file_, bytes.data(), bytes.size(), static_cast<off_t>(offset)) == static_cast<ssize_t>(bytes.size()))
    return {};
  return Failure();
}

Result<void> AtomicFile::Finish() {
  RETURN_IF_ERROR(Flush());
  if (::close(std::exchange(file_, -1)) != 0) {
    auto failure = Failure();
    std::error_code ignored;
    std::filesystem::remove(TemporaryName(path_), ignored);
    return failure;
  }
  return RenameFinished(TemporaryName(path_), path_);
}

Result<void> ReadInChunks(const std::filesystem::path& path, const std::function<void(std::string_view)>& use) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return Fail(InFile(path), "cannot read this file: {}", std::strerror(errno));
  std::vector<char> chunk(1 << 18);
  while (in.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || in.gcount() > 0) {
    use({chunk.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (in.bad()) return Fail(InFile(path), "cannot read this file: {}", std::strerror(errno));
  return {};
}

Result<void> ForEachLine(const std::filesystem::path& path,
                         const std::function<Result<void>(std::string_view, const Place&)>& use) {
  RETURN_IF_ERROR(CheckReadable(path));
  std::ifstream in(path, std::ios::binary);
  if (!in) return Fail(InFile(path), "cannot read this file: {}", std::strerror(errno));
  Place place{.file = path.string(), .line = 1};
  for (std::string line; std::getline(in, line); ++place.line) RETURN_IF_ERROR(use(line, place));
  if (in.bad()) return Fail(InFile(path), "cannot read this file: {}", std::strerror(errno));
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
  if (!in) return Fail(InFile(path), "cannot read this file: {}", std::strerror(errno));
  std::string bytes;
  bytes.reserve(error ? 0 : size);
  std::array<char, 1 << 16> chunk{};
  while (in.read(chunk.data(), chunk.size()) || in.gcount() > 0) {
    bytes.append(chunk.data(), static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > kLargestFile) return Fail(InFile(path), "grows while it is read");
  }
  if (in.bad()) return Fail(InFile(path), "cannot read this file: {}", std::strerror(errno));
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
  if (error) return Fail({folder.string()}, "cannot be read: {}", error.message());
  return SyncFolder(folder);
}

}  // namespace etude
