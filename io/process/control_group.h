#pragma once

#include <string>

#include "io/process/process_tree.h"

namespace etude {

/// The control group (cgroup v2) that a process is in.
struct OwnGroup {
  std::string folder, top;  ///< its folder, and that of all groups that can be seen; "" without cgroup v2

  /// As the process' files `cgroup` and `mountinfo` in /proc tell.
  static OwnGroup Read(const std::string& groups, const std::string& mounts);
};

/// MB that the processes of a group hold, as its files memory.stat and memory.swap.current tell: without files that the
/// kernel merely keeps at hand.
double HeldMbIn(const std::string& memory_stat, const std::string& swapped);

/// A control group of its own (cgroup v2) for a program and all that it starts: the kernel counts what they hold,
/// whatever it is, and ends them when that is far too much. Removed with this object, when nobody is in it any more.
class ControlGroup {
 public:
  /// Finds the folder below which groups can be made; "" where this machine gives none: that needs cgroup v2 with its
  /// memory controller, and a group above ours, or ours, that belongs to us. Moves this process into a group of its
  /// own where ours has no other process. Removes what groups killed runs have left behind.
  static std::string FindPlace();
  /// The same, of a process in that group.
  static std::string FindPlace(const OwnGroup& of_process);

  /// No group.
  ControlGroup() = default;
  /// Makes a group below `place` for a program that may hold `max_mb`; none where `place` is "", or it cannot be made.
  static ControlGroup Make(const std::string& place, double max_mb);
  ControlGroup(ControlGroup&& other) noexcept = default;
  ControlGroup& operator=(ControlGroup&& other) noexcept;
  ~ControlGroup() { Remove(); }

  bool IsUp() const { return folder_.number() >= 0; }
  /// The descriptor of its folder, to start a process in it; -1 = none.
  int folder() const { return folder_.number(); }
  /// True if no process is in it.
  bool IsEmpty() const { return Read("cgroup.procs").empty(); }
  /// What it holds now, MB (HeldMbIn).
  double HeldMb() const;
  /// True if the kernel has ended somebody in it since it held far too much.
  bool WasFull() const;

 private:
  std::string Read(const char* name) const;
  void Remove();

  std::string path_;
  Descriptor folder_;
};

}  // namespace etude
