#include "bench/results/npy.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <utility>

#include "engine/base/machine.h"

namespace etude {
namespace {

std::size_t SizeOf(std::string_view type) { return static_cast<std::size_t>(type.back() - '0'); }

void EndAfterCutFile(int) {
  constexpr std::string_view kComplaint = "etude: another program shortened a file of the run while etude read it\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kComplaint.data(), kComplaint.size());
  ::_exit(3);  // the exit code for faults of the machine
}

}  // namespace

void ExitOnTruncatedMapping() { std::signal(SIGBUS, EndAfterCutFile); }

Result<NpyWriter> NpyWriter::Begin(const FilePath& path, std::string_view type) {
  ASSIGN_OR_RETURN(auto file, AtomicFile::Begin(path));
  RETURN_IF_ERROR(file.Write(std::string(kNpyHead, ' ')));
  return NpyWriter(std::move(file), type);
}

Result<void> NpyWriter::Finish(std::vector<std::size_t> shape) {
  if (shape.empty()) shape = {count_};
  RETURN_IF_ERROR(file_.Overwrite(0, NpyHead(type_, shape)));
  return file_.Finish(OnDisk::kLater);
}

Result<NpyFile> NpyFile::Open(const FilePath& path, std::string_view type) {
  const Place place{path.string()};
  ASSIGN_OR_RETURN(const auto file, OpenFile(path, O_RDONLY));
  struct stat status {};
  const bool is_large = ::fstat(file.number(), &status) == 0 && static_cast<std::size_t>(status.st_size) >= kNpyHead;
  const auto size = is_large ? static_cast<std::size_t>(status.st_size) : 0;
  void* const memory = is_large ? ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number(), 0) : MAP_FAILED;
  if (!is_large) return Fail(place, "is not a column: it is too short");
  if (memory == MAP_FAILED) return CannotRead(path.string(), "cannot read this file", errno);
  NpyFile opened(static_cast<const char*>(memory), size);
  const std::string_view head(opened.data_, kNpyHead);
  const std::string wanted = NpyHead(type, {});
  if (!head.starts_with(std::string_view(wanted).substr(0, wanted.find("), }"))) ||
      (size - kNpyHead) % SizeOf(type) != 0) {
    return Fail(place, "is not a column of numbers of type {}", type);
  }
  return opened;
}

bool NpyFile::HasShape(std::string_view type, std::span<const std::size_t> shape) const {
  return std::string_view(data_, kNpyHead) == NpyHead(type, shape);
}

NpyFile::NpyFile(NpyFile&& other) noexcept { *this = std::move(other); }

NpyFile& NpyFile::operator=(NpyFile&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

NpyFile::~NpyFile() {
  if (data_ != nullptr) ::munmap(const_cast<char*>(data_), size_);
}

}  // namespace etude
