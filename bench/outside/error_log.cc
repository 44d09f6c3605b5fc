#include "bench/outside/error_log.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <tuple>

#include "bench/process/child_process.h"

namespace etude {
namespace {

constexpr long kTail = 4096;  ///< bytes in which the last line is looked for

}  // namespace

ErrorLog::ErrorLog(std::string file) : file_(std::move(file)) {
  if (file_.empty()) return;
  memory_ = ::memfd_create("standard error", MFD_CLOEXEC);
  if (memory_ < 0) MakeItsFolder();
}

ErrorLog::~ErrorLog() {
  Save();
  if (memory_ >= 0) ::close(memory_);
}

// Where there is no memory file, the program writes to the real one at once.
std::string ErrorLog::path() const { return memory_ < 0 ? file_ : fmt::format("/proc/{}/fd/{}", ::getpid(), memory_); }

long ErrorLog::Size() const {
  struct stat status {};
  return memory_ >= 0 && ::fstat(memory_, &status) == 0 ? static_cast<long>(status.st_size) : 0;
}

// A hole takes no memory, and what the program appends meanwhile stays, which a file made shorter would lose: that is
// done only before the program meets the limit of its files.
void ErrorLog::Trim() {
  const long end = Size() - kTail;
  if (end <= kLargest) return;
  if (end < static_cast<long>(ProgramLimits::kFileBytes / 2)) {
    std::ignore = ::fallocate(memory_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, kLargest, end - kLargest);
  } else {
    std::ignore = ::ftruncate(memory_, kLargest);
  }
}

std::string ErrorLog::Read(long start, long size) const {
  std::string text(static_cast<std::size_t>(size), '\0');
  const ssize_t count = ::pread(memory_, text.data(), text.size(), start);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text;
}

std::string ErrorLog::LastLine() const {
  const long size = Size();
  std::string tail = Read(std::max(size - kTail, 0L), std::min(size, kTail));
  const std::size_t last = tail.find_last_not_of(" \t\r\n");
  if (last == std::string::npos) return "";
  tail.resize(last + 1);
  return tail.substr(tail.find_last_of('\n') + 1);  // npos + 1 = 0
}

// The folder is made only when there is something to keep: most runs have none.
void ErrorLog::MakeItsFolder() const {
  std::error_code ignored;  // what a program says is not worth failing a cell
  std::filesystem::create_directories(std::filesystem::path(file_).parent_path(), ignored);
}

void ErrorLog::Save() {
  const long size = Size();
  if (size == 0) return;
  MakeItsFolder();
  std::error_code absent;
  const auto saved = std::filesystem::file_size(file_, absent);
  const long room = absent ? kLargest : kLargest - static_cast<long>(std::min<std::uintmax_t>(saved, kLargest));
  std::ofstream(file_, std::ios::binary | std::ios::app) << Read(0, std::min(size, room));
  if (::ftruncate(memory_, 0) != 0) return;
}

}  // namespace etude
