#pragma once

#include <sys/types.h>

#include <vector>

#include "bench/process/descriptor.h"

namespace etude {

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
