#include "io/process/tree_meter.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <linux/kcmp.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <numeric>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "io/process/process_tree.h"

namespace etude {
namespace {

constexpr double kMb = 1 << 20;

// Kernel memory per thread, mapping and lock, measured on Linux 6.18 (docs/outside-methods.md).
constexpr double kThreadMb = 25e3 / kMb, kMappingMb = 250 / kMb, kLockMb = 250 / kMb;

constexpr std::size_t kMaxUncheckedDescriptors = 256;  // number of descriptors above which pipes are counted
constexpr std::size_t kMaxFreeSockets = 64;            // each socket above this number counts with a full buffer
constexpr std::size_t kMaxLockBytes = 4 << 20;
constexpr std::size_t kEnoughLocks = 17'000;  // more locks than a program may hold (ProgramLimits::kFileLocks)
constexpr int kMaxSamplesUnseen = 3;

/// Returns the processor time of this thread and the wall time since the epoch of Clock.
ElapsedTime Now() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return {static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec),
          std::chrono::duration<double>(Clock::now().time_since_epoch()).count()};
}

/// Returns the number that follows `name` in a file of /proc; 0 if the name is missing.
double FieldOf(std::string_view text, std::string_view name) {
  const std::size_t at = text.find(name);
  return at == std::string_view::npos ? 0
                                      : static_cast<double>(std::strtoull(text.data() + at + name.size(), nullptr, 10));
}

/// An upper bound on the memory of one process (/proc/<pid>/status): shared pages count in full.
struct ProcessBound {
  double private_mb = 0;  ///< anonymous pages and pages of files, resident or swapped
  double shared_mb = 0;   ///< pages of shared memory and tmpfs
  double page_tables_mb = 0;
  std::size_t threads = 0, descriptors = 0;
};

std::size_t CountDescriptors(pid_t process, std::string_view status) {
  const std::string folder = fmt::format("/proc/{}/fd", process);
  struct stat told {};
  if (::stat(folder.c_str(), &told) == 0 && told.st_size > 0) return static_cast<std::size_t>(told.st_size);
  DIR* files = ::opendir(folder.c_str());  // Linux before 6.2 does not state the number
  if (files == nullptr) return static_cast<std::size_t>(FieldOf(status, "\nFDSize:"));
  std::size_t count = 0;
  while (const dirent* file = ::readdir(files)) count += file->d_name[0] != '.' ? 1 : 0;
  ::closedir(files);
  return count;
}

ProcessBound BoundOf(pid_t process) {
  const std::string status = ReadProcFile(fmt::format("/proc/{}/status", process));
  const auto mb = [&](std::string_view name) { return FieldOf(status, name) / 1024; };
  return {mb("\nRssAnon:") + mb("\nRssFile:") + mb("\nVmSwap:"), mb("\nRssShmem:"), mb("\nVmPTE:"),
          static_cast<std::size_t>(FieldOf(status, "\nThreads:")), CountDescriptors(process, status)};
}

/// Returns the private memory of a process, MB, where a page that n processes map counts 1/n (PSS); `bound_mb` if the
/// kernel refuses to state the private memory, 0 if the process has ended.
double ProportionalMb(pid_t process, double bound_mb) {
  const std::string shares = ReadProcFile(fmt::format("/proc/{}/smaps_rollup", process));
  if (shares.empty()) return ::access(fmt::format("/proc/{}", process).c_str(), F_OK) == 0 ? bound_mb : 0;
  return (FieldOf(shares, "\nPss_Anon:") + FieldOf(shares, "\nPss_File:") + FieldOf(shares, "\nSwapPss:")) / 1024;
}

/// Counts the different pipes, including named pipes, that processes hold open. If the descriptors of a process cannot
/// be read, each descriptor of this process counts as a pipe.
std::size_t CountPipes(const std::vector<pid_t>& processes) {
  std::set<std::pair<dev_t, ino_t>> pipes;
  std::size_t hidden = 0;
  for (const pid_t process : processes) {
    const std::string folder = fmt::format("/proc/{}/fd", process);
    DIR* files = ::opendir(folder.c_str());
    if (files == nullptr) {
      if (errno != EACCES) continue;  // the process has ended
      hidden += CountDescriptors(process, ReadProcFile(fmt::format("/proc/{}/status", process)));
      continue;
    }
    while (const dirent* file = ::readdir(files)) {
      struct stat status {};
      if (::fstatat(::dirfd(files), file->d_name, &status, 0) == 0 && S_ISFIFO(status.st_mode)) {
        pipes.emplace(status.st_dev, status.st_ino);
      }
    }
    ::closedir(files);
  }
  return pipes.size() + hidden;
}

/// Counts the file locks of processes, up to kEnoughLocks. The time that the kernel needs for its list of locks grows
/// with the square of the length read, so reading stops as soon as the count is high enough.
std::size_t CountLocks(const std::vector<pid_t>& processes) {
  const std::set<pid_t> ours(processes.begin(), processes.end());
  const int file = ::open("/proc/locks", O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  std::size_t count = 0, read = 0;
  std::string text;  // text that was read but not yet counted
  std::array<char, 4096> chunk;
  for (ssize_t size; count < kEnoughLocks && read < kMaxLockBytes;) {
    if ((size = ::read(file, chunk.data(), chunk.size())) <= 0) break;
    read += static_cast<std::size_t>(size);
    text.append(chunk.data(), static_cast<std::size_t>(size));
    // A line looks like "1: POSIX  ADVISORY  WRITE 1234 fe:00:5678 0 EOF"; the line of a waiting lock begins with "1:
    // ->".
    std::size_t at = 0;
    for (std::size_t end; (end = text.find('\n', at)) != std::string::npos; at = end + 1) {
      const std::string line = text.substr(at, end - at);
      int owner = 0;
      const char* rest = std::strstr(line.c_str(), "ADVISORY");
      if (rest != nullptr && std::sscanf(rest, "%*s %*s %d", &owner) == 1 && ours.contains(owner)) ++count;
    }
    text.erase(0, at);
  }
  ::close(file);
  return count;
}

std::size_t CountSockets(pid_t process) {
  return static_cast<std::size_t>(
      FieldOf(ReadProcFile(fmt::format("/proc/{}/net/sockstat", process)), "sockets: used "));
}

/// Returns the bytes in the queues of all TCP sockets in the network namespace of a process.
double QueuedTcpBytes(pid_t process) {
  double bytes = 0;
  for (const char* name : {"tcp", "tcp6"}) {
    const std::string table = ReadProcFile(fmt::format("/proc/{}/net/{}", process, name));
    for (std::size_t at = table.find('\n'); at != std::string::npos; at = table.find('\n', at + 1)) {
      unsigned long sent = 0, received = 0;
      if (std::sscanf(table.c_str() + at + 1, " %*s %*s %*s %*s %lx:%lx", &sent, &received) == 2) {
        bytes += static_cast<double>(sent + received);
      }
    }
  }
  return bytes;
}

/// Returns the buffer size of a socket that is not TCP, MB; the fence's filter prevents changes of this size.
double FullSocketMb() {
  static const double size = std::atof(ReadProcFile("/proc/sys/net/core/wmem_default").c_str()) / kMb;
  return size;
}

bool HasOwnNetwork(pid_t process) {
  struct stat theirs {
  }, ours{};
  return ::stat(fmt::format("/proc/{}/ns/net", process).c_str(), &theirs) == 0 &&
         ::stat("/proc/self/ns/net", &ours) == 0 && theirs.st_ino != ours.st_ino;
}

/// Adds a range to a set of disjoint ranges, and merges ranges that touch.
void AddPart(std::map<std::uint64_t, std::uint64_t>& parts, std::uint64_t begin, std::uint64_t end) {
  auto next = parts.upper_bound(begin);
  if (next != parts.begin() && std::prev(next)->second >= begin) --next;
  while (next != parts.end() && next->first <= end) {
    begin = std::min(begin, next->first);
    end = std::max(end, next->second);
    next = parts.erase(next);
  }
  parts[begin] = end;
}

}  // namespace

bool Starves(const ElapsedTime& measuring, double cores_of_tree, double cores) {
  constexpr double kExpensive_s = 0.005, kMaxWait = 4;
  return measuring.cpu_s > kExpensive_s && measuring.wall_s > kMaxWait * measuring.cpu_s && cores_of_tree > 0.5 * cores;
}

TreeLoad TreeMeter::Count() {
  started_ = Now();
  processes_ = ProcessTree(root_);
  bounds_mb_.assign(processes_.size(), 0);
  const TreeLoad before = std::exchange(load_, {});
  page_tables_mb_ = max_shared_mb_ = 0;

  // Read two small files per process, of children before their parents, because a process that ends makes its parent
  // busy.
  std::map<pid_t, std::uint64_t> faults;
  for (std::size_t i = processes_.size(); i-- > 0;) {
    const pid_t process = processes_[i];
    ClaimTime();
    const ProcessUsage usage = MeasureProcess(process);
    const ProcessBound bound = BoundOf(process);
    load_.cpu_s += usage.cpu_s;
    load_.processes += usage.processes;
    load_.is_busy = load_.is_busy || usage.is_busy;
    load_.ending += usage.is_ending ? 1 : 0;
    load_.threads += bound.threads;
    load_.descriptors += bound.descriptors;
    const auto known = faults_.find(process);
    touched_pages_ += usage.faults - (known == faults_.end() ? 0 : std::min(known->second, usage.faults));
    faults[process] = usage.faults;
    bounds_mb_[i] = bound.private_mb;
    page_tables_mb_ += bound.page_tables_mb;
    max_shared_mb_ = std::max(max_shared_mb_, bound.shared_mb);
  }
  of_tree_ = {load_.cpu_s, Now().wall_s};
  faults_ = std::move(faults);
  min_since_mb_ = std::min(min_since_mb_, max_shared_mb_);
  max_since_mb_ = std::max(max_since_mb_, max_shared_mb_);

  // Read the kernel's lists less often, because they may be long.
  load_.sockets = before.sockets;
  load_.file_locks = before.file_locks;
  load_.pipes = before.pipes;
  if (const Clock::time_point start = Clock::now(); kernel_pace_.IsDue(start)) {
    const bool has_network = processes_.size() > 1 && HasOwnNetwork(processes_[1]);
    load_.sockets = has_network ? CountSockets(processes_[1]) : 0;
    tcp_mb_ = has_network ? QueuedTcpBytes(processes_[1]) / kMb : 0;
    load_.file_locks = CountLocks(processes_);
    kernel_pace_.Took(start);
  }
  if (load_.descriptors <= kMaxUncheckedDescriptors) {
    load_.pipes = 0;
  } else if (const Clock::time_point start = Clock::now(); pipes_pace_.IsDue(start)) {
    load_.pipes = CountPipes(processes_);
    pipes_pace_.Took(start);
  }
  return load_;
}

double TreeMeter::HeldMb(double scratch_mb, double precise_from_mb) {
  if (const Clock::time_point start = Clock::now(); mappings_pace_.IsDue(start)) {
    SampleMappings();
    mappings_pace_.Took(start);
  }
  double shared_mb = scratch_mb;
  for (const auto& [inode, memory] : shared_) shared_mb += memory.Mb();
  const auto full_sockets = static_cast<double>(std::max(load_.sockets, kMaxFreeSockets) - kMaxFreeSockets);
  const double others_mb = std::max(shared_mb, max_shared_mb_) + page_tables_mb_ +
                           kThreadMb * static_cast<double>(load_.threads) +
                           kMappingMb * static_cast<double>(mappings_) +
                           kLockMb * static_cast<double>(load_.file_locks) + FullSocketMb() * full_sockets + tcp_mb_;

  if (others_mb > limit_mb_) return others_mb;

  // Private memory grows only by touched pages. So the last precise value plus the growth since then is an upper bound.
  static const double mb_per_page = static_cast<double>(::sysconf(_SC_PAGESIZE)) / kMb;
  const double bound_mb = std::accumulate(bounds_mb_.begin(), bounds_mb_.end(), 0.0);
  const double touched_mb = static_cast<double>(touched_pages_ - precise_.touched_pages) * mb_per_page;
  double private_mb = std::min(bound_mb, precise_.private_mb + std::max(bound_mb - precise_.bound_mb, touched_mb));
  if (private_mb + others_mb > precise_from_mb) {
    private_mb = 0;
    for (std::size_t i = 0; i < processes_.size(); ++i) {
      ClaimTime();
      if (!SharesMemoryBefore(i)) private_mb += ProportionalMb(processes_[i], bounds_mb_[i]);
    }
    precise_ = {private_mb, bound_mb, touched_pages_};
  }
  return private_mb + others_mb;
}

void TreeMeter::ClaimTime() {
  // Measure the tree's processor time only if this process has waited for most of a long measurement.
  const ElapsedTime now = Now();
  const ElapsedTime measuring{now.cpu_s - started_.cpu_s, now.wall_s - started_.wall_s};
  static const double cores = std::thread::hardware_concurrency();
  if (!Starves(measuring, cores, cores)) return;
  const std::vector<pid_t> processes = ProcessTree(root_);
  double cpu_s = 0;
  for (const pid_t process : processes) cpu_s += MeasureProcess(process).cpu_s;
  const double cores_of_tree = (cpu_s - of_tree_.cpu_s) / (now.wall_s - of_tree_.wall_s);
  // Processes that start later inherit the priority.
  if (Starves(measuring, cores_of_tree, cores)) std::ranges::for_each(processes, LowerPriority);
  started_ = Now();
}

bool TreeMeter::SharesMemoryBefore(std::size_t at) const {
  for (std::size_t i = 0; i < at; ++i) {
    if (std::abs(bounds_mb_[i] - bounds_mb_[at]) > 1) continue;
    if (::syscall(SYS_kcmp, processes_[i], processes_[at], KCMP_VM, 0, 0) == 0) return true;
  }
  return false;
}

double TreeMeter::SharedMemory::Mb() const {
  double mb = hidden_mb;
  for (const auto& [begin, end] : parts) mb += static_cast<double>(end - begin) / kMb;
  return mb;
}

void TreeMeter::SampleMappings() {
  // Find the anonymous shared mappings of all processes.
  for (auto& [inode, memory] : shared_) ++memory.samples_unseen;
  mappings_ = 0;
  for (const pid_t process : processes_) {
    ClaimTime();
    const std::string maps = ReadProcFile(fmt::format("/proc/{}/maps", process));
    mappings_ += static_cast<std::size_t>(std::ranges::count(maps, '\n'));
    constexpr std::string_view kName = "/dev/zero (deleted)\n";  // the kernel's name of anonymous shared memory
    for (std::size_t at = 0; (at = maps.find(kName, at)) != std::string::npos; at += kName.size()) {
      unsigned long begin = 0, end = 0, offset = 0, inode = 0;
      const char* line = maps.c_str() + maps.rfind('\n', at) + 1;  // at the first line, npos + 1 = 0
      if (std::sscanf(line, "%lx-%lx %*2c%*c%*1[s] %lx %*s %lu", &begin, &end, &offset, &inode) != 4) continue;
      AddPart(shared_[inode].parts, offset, offset + (end - begin));
      shared_[inode].samples_unseen = 0;
    }
    if (kMappingMb * static_cast<double>(mappings_) > limit_mb_) break;
  }
  // Forget a mapping only after several samples: a process that started during this sample may still map it.
  std::erase_if(shared_, [](const auto& one) { return one.second.samples_unseen > kMaxSamplesUnseen; });

  // Pages that were mapped and unmapped since the last sample may belong to any of the new mappings.
  double gone_mb = std::exchange(max_since_mb_, max_shared_mb_) - std::exchange(min_since_mb_, max_shared_mb_);
  for (const auto& [inode, memory] : shared_) gone_mb -= memory.is_new ? memory.Mb() : 0;
  for (auto& [inode, memory] : shared_) {
    if (std::exchange(memory.is_new, false)) memory.hidden_mb = std::max(gone_mb, 0.0);
  }
}

}  // namespace etude
