#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/files/descriptor.h"

namespace etude {

/// The memory and processor time of one process.
struct ProcessUsage {
  double resident_mb = 0;     ///< pages that it shares with others count in full
  double cpu_s = 0;           ///< with what was used by those that it has waited for
  std::uint64_t faults = 0;   ///< pages that it has touched for the first time, or that had to be copied
  std::size_t processes = 0;  ///< 1; 0 when it has vanished
  double own_cpu_s = 0;       ///< without those waited for
};

/// The text of one of /proc's files, or its first `max_bytes` and a bit; "" when the process has vanished.
std::string ReadProcFile(const std::string& path, std::size_t max_bytes = std::size_t{1} << 30);

/// `root` and all its living descendants, parents first. Processes come and go while this looks: it is
/// what was seen on the way. Stops at 4096 of them.
std::vector<pid_t> ProcessTree(pid_t root);

/// Lists the processes that any thread of `parent` has started, or adopted.
std::vector<pid_t> ChildrenOf(pid_t parent);

/// The process alone, without its descendants; zeros when it has vanished.
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
