#pragma once

#include <sys/types.h>

#include <vector>

#include "bench/files/descriptor.h"

namespace etude {

/// The memory and processor time of a process and all its descendants.
struct ProcessUsage {
  double resident_mb = 0;  ///< pages that several of them share count for each
  double cpu_s = 0;        ///< with what was used by those that they have waited for
  std::size_t processes = 0;
};

/// `root` and all its living descendants, parents first. Processes come and go while this looks: it is
/// what was seen on the way. Stops at 4096 of them.
std::vector<pid_t> ProcessTree(pid_t root);

/// Lists the processes that any thread of `parent` has started, or adopted.
std::vector<pid_t> ChildrenOf(pid_t parent);

/// Zeros for what has vanished.
ProcessUsage MeasureTree(pid_t root);
/// The size of all mappings that a tree shares and no file backs: they may hold memory that is in nobody's resident
/// size. Takes some 0.1 ms a process.
double MeasureSharedMappingsMb(pid_t root);
/// The process alone, without its descendants.
ProcessUsage MeasureProcess(pid_t process);

/// A process and its descendants, held so that ending them cannot hit another process that has been given one of
/// their numbers meanwhile.
class HeldTree {
 public:
  explicit HeldTree(pid_t root);

  /// Ends all of them, and all that they have started since.
  void Kill();

 private:
  struct Process {
    pid_t number;
    Descriptor handle;  ///< a pidfd
  };
  /// Takes hold of what the held ones have started since; whether there was any.
  bool Grow();
  void AddTree(pid_t root);
  void SignalAll(int signal) const;

  std::vector<Process> processes_;
};

}  // namespace etude
