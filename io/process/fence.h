#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The words that run a program behind a fence, and what bubblewrap is told besides: what programs inside could read in
/// its command line must not name our folders.
struct FencedCommand {
  std::vector<std::string> words;             ///< a path and arguments
  std::vector<std::string> told = {};         ///< what descriptors 3 and 4 give (ChildOptions::told)
  std::vector<std::string> environment = {};  ///< ChildOptions::environment, of bubblewrap and what is inside
};

/// Temporary files, which are memory.
struct ScratchUse {
  double mb = 0;  ///< of what was written to them
  double names_mb = 0,
         inodes_mb =
             0;  ///< what the kernel keeps of each: its name, which it takes for easy to find again, and the rest

  double Mb() const { return mb + names_mb + inodes_mb; }
};

/// A fence around programs that are not ours, made by bubblewrap where the kernel lets it: user, process, mount, ipc
/// and network namespaces of their own, no capabilities, and of all files only the system's, what they are shown, both
/// read-only, and scratch folders that go with them (docs/outside-methods.md).
class Fence {
 public:
  /// No fence: programs run as we do.
  Fence() = default;
  /// The fence that this machine allows, tried once; else none, and `description` says why.
  static Fence Find();
  /// The fence that another process has found: its `program`, and the `kept` and the `groups` that it tells.
  static Fence Of(const std::string& program, std::vector<std::filesystem::path> kept = {}, std::string groups = "");
  /// Tells whether every program sees a path, as part of the system.
  static bool IsOfSystem(const std::filesystem::path& path);
  /// The sockets and named pipes below a folder, which can be written to through a read-only mount.
  static std::vector<std::filesystem::path> PipesBelow(const std::filesystem::path& folder);
  /// Tells whether a folder holds one that programs have to write to, so that it cannot be shown as it is.
  static bool HoldsScratch(const std::filesystem::path& folder);

  bool IsUp() const { return !program_.empty(); }
  /// The path of bubblewrap; "" = no fence.
  const std::string& program() const { return program_; }
  /// "bubblewrap 0.8.0"; "none (not asked for)".
  const std::string& description() const { return description_; }

  /// Says how many programs run in such fences at the same time, and share what the kernel counts by user.
  void ShareBy(int programs) { programs_ = programs; }
  int programs() const { return programs_; }

  /// ControlGroup::FindPlace; "" without a fence.
  const std::string& groups() const { return groups_; }
  /// "counted by the kernel (cgroup v2)"; by whom the memory of programs inside is counted.
  std::string MemoryDescription() const;

  /// Has programs inside see a folder empty, and a file not at all, even where the system or what is shown holds it.
  void Hide(const std::filesystem::path& path) { hidden_.push_back(path); }
  const std::vector<std::filesystem::path>& hidden() const { return hidden_; }
  /// What of the system is not shown unless a program is granted it: what only root can read, where root asks.
  const std::vector<std::filesystem::path>& kept() const { return kept_; }

  /// What is in the scratch folders that a process inside sees.
  ScratchUse MeasureScratch(pid_t inside) const;

  /// Fails, with an error of this machine, when nothing can be run inside now, though it could.
  Result<void> Try() const;

  /// The words that run `command`, a path and arguments, inside, in the folder `start` ("" = /tmp); `command` itself
  /// without a fence. It sees `shown`, files and folders by absolute paths, beside the system.
  FencedCommand Around(const std::vector<std::string>& command, const std::vector<std::filesystem::path>& shown,
                       const std::filesystem::path& start = {}) const;

 private:
  std::string program_, groups_;
  int programs_ = 1;
  std::string description_ = "none (not asked for)";
  std::vector<std::filesystem::path> hidden_, kept_;
};

}  // namespace etude
