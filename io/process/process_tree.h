#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/files/descriptor.h"

namespace etude {

struct ProcessUsage {
  double resident_mb = 0;     ///< shared pages count in full
  double cpu_s = 0;           ///< includes ended child processes that the process has waited for
  std::uint64_t faults = 0;   ///< minor page faults: pages touched for the first time, or copied on write
  std::size_t processes = 0;  ///< number of processes: 1, or 0 if the process no longer exists
  double own_cpu_s = 0;       ///< processor time without the time of child processes
  bool is_busy = false;       ///< the first thread computes, or waits for a disk
  bool is_ending = false;     ///< the process ends, or has ended and its parent has not waited for it
};

/// Reads at most `max_bytes` + 4 KiB of a file in /proc; returns "" if the process does not exist any more.
std::string ReadProcFile(const std::string& path, std::size_t max_bytes = std::size_t{1} << 30);

/// Returns `root` and its living descendants, parents before children, at most 4096 processes. Processes may start and
/// end during the search, so the list is not an exact snapshot.
std::vector<pid_t> ProcessTree(pid_t root);

/// Returns the living children of `parent`, including adopted children.
std::vector<pid_t> ChildrenOf(pid_t parent);

/// Returns true if a process holds the pipe of which `end` is a descriptor, or may hold it.
bool MayHoldPipe(pid_t process, int end);

/// Measures one process without its living descendants; returns zeros if the process does not exist any more.
ProcessUsage MeasureProcess(pid_t process);

/// Gives the lowest priority to all threads of a process, and to everything that these threads start from now on.
void LowerPriority(pid_t process);

/// A process and its descendants, held by pidfds. If a process of the tree has ended and another process gets its ID,
/// Kill does not hit that other process.
class HeldTree {
 public:
  explicit HeldTree(pid_t root);

  /// Kills all processes of the tree, and all descendants that were started meanwhile.
  void Kill();

 private:
  struct Process {
    pid_t number;
    Descriptor handle;  ///< a pidfd of the process
  };
  /// Adds descendants that were started since the last call; returns true if it added any.
  bool Grow();
  void AddTree(pid_t root);
  void SignalAll(int signal) const;

  std::vector<Process> processes_;
};

}  // namespace etude
