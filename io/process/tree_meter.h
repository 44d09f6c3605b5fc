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

/// The resources that a program and its descendants hold, and the processor time that these processes have used.
struct TreeLoad {
  double cpu_s = 0;  ///< includes the time of ended processes that these processes have waited for
  std::size_t processes = 0, threads = 0;
  std::size_t descriptors = 0;  ///< open files of all processes
  std::size_t pipes = 0;        ///< pipes, which are counted only if there are more than 256 descriptors
  /// Sockets in the tree's network namespace, and sockets in transit over other sockets; 0 without a namespace.
  std::size_t sockets = 0;
  std::size_t file_locks = 0;
  std::size_t ending = 0;  ///< number of processes that end or have ended (ProcessUsage)
  bool is_busy = false;    ///< at least one of the processes is busy (ProcessUsage)
};

/// The time that this thread has computed, and the time that has passed.
struct ElapsedTime {
  double cpu_s = 0;
  double wall_s = 0;
};

/// Returns true if a tree of processes starves the process that measures it: a long measurement has mostly waited for
/// the processor, while the tree used more than half of all cores.
bool Starves(const ElapsedTime& measuring, double cores_of_tree, double cores);

/// Measures the resources of a tree of processes by repeated sampling, for machines without control groups: it counts
/// each page once, however many processes share it, and adds the kernel's memory for the processes.
///
/// A sample reads two small files per process, about 30 µs. These files give an upper bound on memory, which usually
/// suffices. Expensive files are read less often, or only if the bound is near the limit. A tree that starves this
/// process (Starves) gets the lowest priority from then on.
class TreeMeter {
 public:
  /// `limit_mb` is the memory that the tree may hold.
  TreeMeter(pid_t root, double limit_mb) : root_(root), limit_mb_(limit_mb) {}

  /// Takes a sample and returns the load; HeldMb then returns the memory.
  TreeLoad Count();
  /// Returns the memory of the processes of the last Count, MB, including `scratch_mb` of temporary files. A result
  /// below `precise_from_mb` may be an upper bound, in which shared pages count once per process; a result above the
  /// limit may be a lower bound.
  double HeldMb(double scratch_mb, double precise_from_mb);

 private:
  /// Schedules a repeated action so that it takes at most 5 % of the time, if one run takes less than 16 ms.
  class Pace {
   public:
    explicit Pace(std::chrono::milliseconds min_interval) : min_interval_(min_interval) {}
    bool IsDue(Clock::time_point now) const { return now >= next_; }
    void Took(Clock::time_point start) {
      const Clock::time_point now = Clock::now();
      constexpr std::chrono::milliseconds kMaxPause{300};  // the maximum, so that a slow action is repeated in time
      next_ = std::max<Clock::time_point>(start + min_interval_,
                                          now + std::min<Clock::duration>(19 * (now - start), kMaxPause));
    }

   private:
    std::chrono::milliseconds min_interval_;
    Clock::time_point next_{};
  };

  /// One anonymous shared mapping (shmem). The mapping exists while any process maps a part of it, and it keeps the
  /// pages of parts that no process maps any more.
  struct SharedMemory {
    std::map<std::uint64_t, std::uint64_t> parts;  ///< all byte ranges ever seen mapped: begin → end
    double hidden_mb = 0;                          ///< upper bound on parts that were unmapped before the first sample
    int samples_unseen = 0;                        ///< consecutive samples in which no process mapped this mapping
    bool is_new = true;                            ///< first seen in the current sample

    double Mb() const;
  };

  /// Reads the memory mappings of all processes. Stops early when the kernel's memory for the mappings alone exceeds
  /// the limit.
  void SampleMappings();
  /// Gives the tree the lowest priority if it starves this process; called repeatedly during a measurement.
  void ClaimTime();
  /// Returns true if a process shares its whole memory with an earlier process in the list, as a child of vfork does.
  bool SharesMemoryBefore(std::size_t at) const;

  const pid_t root_;
  const double limit_mb_;
  ElapsedTime started_;  ///< the start of this measurement, or the time of its latest check for starvation
  ElapsedTime of_tree_;  ///< the tree's processor time at the last Count, and the time of that Count
  Pace mappings_pace_{std::chrono::milliseconds(0)}, kernel_pace_{std::chrono::milliseconds(100)};
  Pace pipes_pace_{std::chrono::milliseconds(0)};
  std::vector<pid_t> processes_;
  std::vector<double> bounds_mb_;  ///< each process's anonymous pages and pages of files, MB; shared ones count in full
  TreeLoad load_;
  double page_tables_mb_ = 0, tcp_mb_ = 0;
  /// The shared pages of the process that maps more shared pages than any other process, MB: now, and the minimum and
  /// maximum since SampleMappings.
  double max_shared_mb_ = 0, min_since_mb_ = 0, max_since_mb_ = 0;
  std::size_t mappings_ = 0;                      ///< number of mappings that were read
  std::map<std::uint64_t, SharedMemory> shared_;  ///< all shared mappings, by inode
  std::map<pid_t, std::uint64_t> faults_;         ///< page faults of each process in the last sample
  std::uint64_t touched_pages_ = 0;               ///< page faults of all processes since the start

  struct {
    double private_mb = 0, bound_mb = 0;
    std::uint64_t touched_pages = 0;
  } precise_;
};

}  // namespace etude
