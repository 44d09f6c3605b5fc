#include "bench/files/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "bench/files/files.h"

namespace etude {
namespace {

constexpr std::size_t kBuffer = 1 << 16;

}  // namespace

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

}  // namespace etude
