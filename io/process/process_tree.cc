#include "io/process/process_tree.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>

namespace etude {
namespace {

constexpr std::size_t kMaxProcesses = 4096;
constexpr unsigned kExiting = 4;  // the kernel's flag PF_EXITING in /proc/<pid>/stat

/// Returns the living threads of a process.
std::vector<pid_t> ThreadsOf(pid_t process) {
  std::vector<pid_t> threads;
  DIR* folder = ::opendir(fmt::format("/proc/{}/task", process).c_str());
  if (folder == nullptr) return threads;
  while (const dirent* thread = ::readdir(folder)) {
    if (thread->d_name[0] != '.') threads.push_back(static_cast<pid_t>(std::atoi(thread->d_name)));
  }
  ::closedir(folder);
  return threads;
}

void AddChildren(pid_t parent, std::vector<pid_t>& processes) {
  for (const pid_t thread : ThreadsOf(parent)) {
    const std::string children = ReadProcFile(fmt::format("/proc/{}/task/{}/children", parent, thread));
    const char* at = children.c_str();
    for (char* end = nullptr; processes.size() < kMaxProcesses; at = end) {
      const long child = std::strtol(at, &end, 10);
      if (end == at) break;
      processes.push_back(static_cast<pid_t>(child));
    }
  }
}

/// Returns the processor time of one process, seconds, with a resolution of nanoseconds; /proc/<pid>/stat has only
/// ticks of 10 ms.
double OwnCpuSeconds(pid_t process) {
  clockid_t clock;
  timespec time;
  if (::clock_getcpuclockid(process, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

constexpr int kMaxPasses = 100;  // maximum number of passes over a tree that grows meanwhile

bool Signal(const Descriptor& process, int signal) {
  return ::syscall(SYS_pidfd_send_signal, process.number(), signal, nullptr, 0) == 0;
}

}  // namespace

std::string ReadProcFile(const std::string& path, std::size_t max_bytes) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return "";
  std::string text;
  std::array<char, 4096> chunk;
  for (ssize_t count; text.size() < max_bytes && (count = ::read(file, chunk.data(), chunk.size())) > 0;) {
    text.append(chunk.data(), static_cast<std::size_t>(count));
  }
  ::close(file);
  return text;
}

ProcessUsage MeasureProcess(pid_t process) {
  const std::string stat = ReadProcFile(fmt::format("/proc/{}/stat", process));
  // The second field is the program's name in parentheses. The name may contain parentheses, too, so all other fields
  // follow the last ')'.
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string::npos) return {};
  char state = 0;
  unsigned flags = 0;
  unsigned long faults = 0;
  long user_waited_for = 0, system_waited_for = 0, resident_pages = 0;
  const int read =
      std::sscanf(stat.c_str() + name_end + 1,
                  " %c %*s %*s %*s %*s %*s %u %lu %*s %*s %*s %*s %*s"  // fields 3 to 15: reads fields 3, 9, 10
                  " %ld %ld %*s %*s %*s %*s %*s %*s %ld",               // reads fields 16, 17, 24
                  &state, &flags, &faults, &user_waited_for, &system_waited_for, &resident_pages);
  if (read != 6) return {};
  static const double seconds_per_tick = 1.0 / static_cast<double>(::sysconf(_SC_CLK_TCK));
  static const double mb_per_page = static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1024 * 1024);
  const double own_cpu_s = OwnCpuSeconds(process);
  return {static_cast<double>(resident_pages) * mb_per_page,
          own_cpu_s + static_cast<double>(user_waited_for + system_waited_for) * seconds_per_tick,
          faults,
          1,
          own_cpu_s,
          state == 'R' || state == 'D',
          (flags & kExiting) != 0};
}

bool MayHoldPipe(pid_t process, int end) {
  struct stat pipe {};
  if (::fstat(end, &pipe) != 0) return true;
  for (const pid_t thread : ThreadsOf(process)) {  // a thread that has ended shows no descriptors
    DIR* descriptors = ::opendir(fmt::format("/proc/{}/task/{}/fd", process, thread).c_str());
    if (descriptors == nullptr && errno == EACCES) return true;
    bool found = false;
    while (const dirent* descriptor = descriptors == nullptr || found ? nullptr : ::readdir(descriptors)) {
      struct stat held {};
      found = ::fstatat(::dirfd(descriptors), descriptor->d_name, &held, 0) == 0 && held.st_dev == pipe.st_dev &&
              held.st_ino == pipe.st_ino;
    }
    if (descriptors != nullptr) ::closedir(descriptors);
    if (found) return true;
  }
  return false;
}

std::vector<pid_t> ChildrenOf(pid_t parent) {
  std::vector<pid_t> children;
  AddChildren(parent, children);
  return children;
}

std::vector<pid_t> ProcessTree(pid_t root) {
  std::vector<pid_t> processes = {root};
  for (std::size_t i = 0; i < processes.size(); ++i) AddChildren(processes[i], processes);
  return processes;
}

void LowerPriority(pid_t process) {
  constexpr int kLowest = 19;
  for (const pid_t thread : ThreadsOf(process)) ::setpriority(PRIO_PROCESS, static_cast<id_t>(thread), kLowest);
}

HeldTree::HeldTree(pid_t root) {
  AddTree(root);
  for (int i = 0; i < kMaxPasses && Grow(); ++i) {
  }
}

void HeldTree::Kill() {
  // A stopped process starts no other process, but it may have forked just before. So repeat stopping and listing until
  // two passes find nothing new.
  for (int i = 0, quiet = 0; i < kMaxPasses && quiet < 2; ++i) {
    SignalAll(SIGSTOP);
    quiet = Grow() ? 0 : quiet + 1;
  }
  SignalAll(SIGKILL);
}

bool HeldTree::Grow() {
  const std::size_t before = processes_.size();
  for (std::size_t i = 0; i < before; ++i) {
    constexpr int kExists = 0;  // signal 0 only tests whether the process exists
    if (Signal(processes_[i].handle, kExists)) AddTree(processes_[i].number);
  }
  return processes_.size() > before;
}

void HeldTree::AddTree(pid_t root) {
  for (const pid_t number : ProcessTree(root)) {
    const bool known = std::any_of(processes_.begin(), processes_.end(),
                                   [&](const Process& process) { return process.number == number; });
    if (!known) processes_.push_back({number, Descriptor(static_cast<int>(::syscall(SYS_pidfd_open, number, 0)))});
  }
}

void HeldTree::SignalAll(int signal) const {
  for (const Process& process : processes_) Signal(process.handle, signal);
}

}  // namespace etude
