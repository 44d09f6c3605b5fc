#include "bench/results/npy.h"

#include <fcntl.h>
#include <fmt/ranges.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <utility>

#include "engine/base/machine.h"

namespace etude {
namespace {

constexpr std::string_view kMagic("\x93NUMPY\x01\x00", 8);

/// The head of a file: magic, the length of what follows, and a Python dictionary, filled up with spaces.
std::string HeadOf(std::string_view type, std::span<const std::size_t> shape) {
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", type,
                                 fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  const std::size_t length = NpyFile::kHead - kMagic.size() - 2;
  text.resize(length, ' ');
  text.back() = '\n';
  return std::string(kMagic) + static_cast<char>(length & 0xff) + static_cast<char>(length >> 8) + text;
}

/// A file that is mapped, for the signal that tells that it was cut. Entries stay, and serve one file after the other.
struct Mapped {
  std::atomic<const char*> data = nullptr;  ///< null: of no file now
  std::size_t size = 0;
  std::string complaint;
  Mapped* next = nullptr;
};
std::atomic<Mapped*> all_mapped = nullptr;

/// What somebody cuts off a file that we have mapped is not there when we look at it. Nothing can be computed from the
/// rest: ends this process with a complaint.
void OnCut(int signal, siginfo_t* info, void*) {
  const char* const at = static_cast<const char*>(info->si_addr);
  for (const Mapped* one = all_mapped; one != nullptr; one = one->next) {
    const char* const data = one->data;
    if (data == nullptr || at < data || at >= data + one->size) continue;
    constexpr int kOfMachine = 3;  // the exit status of commands that the machine has stopped
    std::ignore = ::write(STDERR_FILENO, one->complaint.data(), one->complaint.size());
    ::_exit(kOfMachine);
  }
  ::signal(signal, SIG_DFL);  // it comes again when we return
}

/// Tells of a file that is mapped, from before it is looked at until `Forget`.
void Tell(const char* data, std::size_t size, const std::string& path) {
  [[maybe_unused]] static const bool is_heard = [] {
    struct sigaction action {};
    action.sa_sigaction = OnCut;
    action.sa_flags = SA_SIGINFO;
    return ::sigaction(SIGBUS, &action, nullptr) == 0;
  }();
  Mapped* entry = all_mapped;
  while (entry != nullptr && entry->data != nullptr) entry = entry->next;
  const bool is_new = entry == nullptr;
  if (is_new) entry = new Mapped;  // for as long as the process lives
  entry->size = size;
  entry->complaint = fmt::format("etude: {}: was cut short while it was read\n", path);
  entry->data = data;
  if (!is_new) return;
  entry->next = all_mapped;
  all_mapped = entry;
}

void Forget(const char* data) {
  for (Mapped* one = all_mapped; one != nullptr; one = one->next) {
    if (one->data == data) one->data = nullptr;
  }
}

std::size_t SizeOf(std::string_view type) { return static_cast<std::size_t>(type.back() - '0'); }

}  // namespace

Result<NpyWriter> NpyWriter::Begin(const FilePath& path, std::string_view type) {
  ASSIGN_OR_RETURN(auto file, AtomicFile::Begin(path));
  RETURN_IF_ERROR(file.Write(std::string(NpyFile::kHead, ' ')));
  return NpyWriter(std::move(file), type);
}

Result<void> NpyWriter::Finish(std::vector<std::size_t> shape) {
  if (shape.empty()) shape = {count_};
  RETURN_IF_ERROR(file_.Overwrite(0, HeadOf(type_, shape)));
  return file_.Finish(OnDisk::kLater);
}

Result<NpyFile> NpyFile::Open(const FilePath& path, std::string_view type) {
  const Place place{path.string()};
  ASSIGN_OR_RETURN(const auto file, OpenFile(path, O_RDONLY));
  struct stat status {};
  const bool is_large = ::fstat(file.number(), &status) == 0 && static_cast<std::size_t>(status.st_size) >= kHead;
  const auto size = is_large ? static_cast<std::size_t>(status.st_size) : 0;
  void* const memory = is_large ? ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.number(), 0) : MAP_FAILED;
  if (!is_large) return Fail(place, "is no column: it is too short");
  if (memory == MAP_FAILED) return CannotRead(path.string(), "cannot read this file", errno);
  NpyFile opened(static_cast<const char*>(memory), size);
  Tell(opened.data_, size, path.string());
  const std::string_view head(opened.data_, kHead);
  const std::string wanted = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': (", type);
  if (!head.starts_with(kMagic) || !head.substr(kMagic.size() + 2).starts_with(wanted) ||
      (size - kHead) % SizeOf(type) != 0) {
    return Fail(place, "is no column of numbers of type {}", type);
  }
  return opened;
}

bool NpyFile::HasShape(std::string_view type, std::span<const std::size_t> shape) const {
  return std::string_view(data_, kHead) == HeadOf(type, shape);
}

NpyFile::NpyFile(NpyFile&& other) noexcept { *this = std::move(other); }

NpyFile& NpyFile::operator=(NpyFile&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

NpyFile::~NpyFile() {
  if (data_ == nullptr) return;
  Forget(data_);
  ::munmap(const_cast<char*>(data_), size_);
}

}  // namespace etude
