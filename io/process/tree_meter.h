#pragma once

#include <sys/types.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "io/process/clock.h"

namespace etude {

/// What a program and all that it has started hold, and what they have used.
struct TreeLoad {
  double cpu_s = 0;  ///< with that of processes that they have waited for
  std::size_t processes = 0, threads = 0;
  std::size_t descriptors = 0;  ///< open files of all processes
  std::size_t pipes = 0;        ///< counted only where there are many descriptors
  std::size_t sockets = 0;      ///< of its network namespace, if it has one: those that wait in queues, too
  std::size_t file_locks = 0;
};

/// Tells what a tree of processes holds, look by look, where the kernel does not count it for us: every page once,
/// however many processes share it, and what the kernel keeps for them.
///
/// A look reads two small files a process, some 30 µs. Bounds from them are enough most of the time; what costs more is
/// read when the bounds are in doubt, or less often.
class TreeMeter {
 public:
  explicit TreeMeter(pid_t root) : root_(root) {}

  /// Looks at the tree.
  TreeLoad Count();
  /// What the processes that were counted last hold, with `scratch_mb` in temporary files, MB. Below `precise_from_mb`
  /// this may be an upper bound, in which pages that processes share count for each.
  double HeldMb(double scratch_mb, double precise_from_mb);

 private:
  /// Has something done every now and then, and leaves nineteen twentieths of the time to others where it is quick.
  class Pace {
   public:
    explicit Pace(std::chrono::milliseconds least) : least_(least) {}
    bool IsDue(Clock::time_point now) const { return now >= next_; }
    /// Notes that what began at `start` has ended.
    void Took(Clock::time_point start) {
      const Clock::time_point now = Clock::now();
      constexpr std::chrono::milliseconds kMaxPause{300};  // what makes looks slow shall not make us blind
      next_ =
          std::max<Clock::time_point>(start + least_, now + std::min<Clock::duration>(19 * (now - start), kMaxPause));
    }

   private:
    std::chrono::milliseconds least_;
    Clock::time_point next_{};
  };

  /// Memory that processes share and no file backs. It lives while anybody maps any part of it, and keeps the pages of
  /// parts that nobody maps any more.
  struct SharedMemory {
    std::map<std::uint64_t, std::uint64_t> parts;  ///< ends by beginnings, bytes: all that was ever seen mapped
    double hidden_mb = 0;                          ///< what it may hold in parts that were gone before the first look
    int looks_unseen = 0;
    bool is_new = true;  ///< at the look that goes on

    double Mb() const;
  };

  void LookAtMappings();
  /// True if a process has the very memory of one before it in the list, as a child has until it becomes a program.
  bool SharesMemoryBefore(std::size_t at) const;

  const pid_t root_;
  Pace mappings_pace_{std::chrono::milliseconds(0)}, kernel_pace_{std::chrono::milliseconds(100)};
  Pace pipes_pace_{std::chrono::milliseconds(0)};
  std::vector<pid_t> processes_;
  std::vector<double> bounds_mb_;  ///< of each of them: its private memory, with pages that it shares with others
  TreeLoad load_;
  double page_tables_mb_ = 0, tcp_mb_ = 0;
  /// Shared pages of the process that maps most of them; at least and at most since the last look at mappings.
  double most_shared_mb_ = 0, least_since_mb_ = 0, peak_since_mb_ = 0;
  std::size_t mappings_ = 0;
  std::map<std::uint64_t, SharedMemory> shared_;  ///< by inode
  std::map<pid_t, std::uint64_t> faults_;         ///< of each process, as last seen
  std::uint64_t touched_pages_ = 0;               ///< by all of them, so far

  /// The last precise look.
  struct {
    double private_mb = 0, bound_mb = 0;
    std::uint64_t touched_pages = 0;
  } precise_;
};

}  // namespace etude
