#pragma once

#include <sys/types.h>

#include <vector>

namespace etude {

/// What a process and all its descendants hold and have used.
struct ProcessUsage {
  double resident_mb = 0;  ///< pages that several of them share count for each
  double cpu_s = 0;        ///< with what was used by those that they have waited for
  std::size_t processes = 0;
};

/// `root` and all its living descendants, parents first. Processes come and go while this looks: it is
/// what was seen on the way. Stops at 4096 of them.
std::vector<pid_t> ProcessTree(pid_t root);

/// Those that any thread of `parent` has started, or adopted.
std::vector<pid_t> ChildrenOf(pid_t parent);

/// Zeros for what has vanished.
ProcessUsage MeasureTree(pid_t root);
/// The process alone, without its descendants.
ProcessUsage MeasureProcess(pid_t process);

}  // namespace etude
