#pragma once

#include <string>

#include "io/process/process_tree.h"

namespace etude {

struct OwnGroup {
  std::string folder, top;  ///< the group's folder, and the mount point of the hierarchy; "" without cgroup v2

  /// Parses the contents of the process's files `cgroup` and `mountinfo` in /proc.
  static OwnGroup Read(const std::string& groups, const std::string& mounts);
};

/// Returns the memory of a group, MB, from the contents of the group's files memory.stat and memory.swap.current:
/// anonymous and shared pages, sockets, kernel memory and swap. The page cache of files and reclaimable kernel memory
/// do not count.
double HeldMbIn(const std::string& memory_stat, const std::string& swapped);

/// A control group (cgroup v2) for one program and its descendants. The kernel counts the memory of all these
/// processes, and kills them if this memory far exceeds the limit. The destructor removes the group as soon as no
/// process is in it.
class ControlGroup {
 public:
  /// Finds the folder in which groups can be made; "" if there is none. Groups can be made only with cgroup v2 and its
  /// memory controller, and only if the group of this process, or a group above it, belongs to this user. If this
  /// process is alone in its group, the function moves it into a new child group, because only a group without
  /// processes can limit its child groups. Also removes groups that killed runs have left.
  static std::string FindPlace();
  static std::string FindPlace(const OwnGroup& of_process);

  ControlGroup() = default;
  /// Makes a group in `place` for a program that may hold `max_mb` MB. Returns no group if `place` is "" or if the
  /// group cannot be made.
  static ControlGroup Make(const std::string& place, double max_mb);
  ControlGroup(ControlGroup&& other) noexcept = default;
  ControlGroup& operator=(ControlGroup&& other) noexcept;
  ~ControlGroup() { Remove(); }

  bool IsUp() const { return folder_.number() >= 0; }
  /// Returns the descriptor of the group's folder, in which a process can be started; −1 = no group.
  int folder() const { return folder_.number(); }
  bool IsEmpty() const { return Read("cgroup.procs").empty(); }
  double HeldMb() const;
  /// Returns true if the kernel has killed a process of the group for lack of memory.
  bool WasFull() const;

 private:
  std::string Read(const char* name) const;
  void Remove();

  std::string path_;
  Descriptor folder_;
};

}  // namespace etude
