#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The command that runs a program in a fence. Bubblewrap reads its own arguments from a descriptor: programs inside
/// the fence can read Bubblewrap's command line, which must not contain the names of our folders.
struct FencedCommand {
  std::vector<std::string> words;                 ///< a path and arguments
  std::vector<std::string> inherited_texts = {};  ///< texts for ChildOptions::inherited_texts
  std::vector<std::string> environment = {};      ///< for ChildOptions::environment: set for bubblewrap and the program
};

/// The memory of temporary files in scratch folders (tmpfs).
struct ScratchUse {
  double mb = 0;  ///< size of the files' contents
  /// Estimated kernel memory of the files' names (which control groups count as reclaimable) and of their inodes.
  double names_mb = 0, inodes_mb = 0;

  double Mb() const { return mb + names_mb + inodes_mb; }
};

/// A fence: the sandbox in which outside programs run, made by bubblewrap if the kernel allows it. Programs inside have
/// user, PID, mount, IPC and network namespaces of their own and no capabilities. They see the system's files and the
/// files shown to them, all read-only, and scratch folders that are removed with the fence (docs/outside-methods.md).
class Fence {
 public:
  /// Makes no fence: programs run with the rights of this process.
  Fence() = default;
  /// Tries once to run bubblewrap, and returns the fence. If that fails, returns no fence, and `description` says why.
  static Fence Find();
  /// Makes a copy of a fence that another process obtained from `Find`. The arguments are the `program`, `kept` and
  /// `groups` of that fence.
  static Fence Of(const std::string& program, std::vector<std::filesystem::path> kept = {}, std::string groups = "");
  /// Returns true if a path belongs to the part of the system that every program sees.
  static bool IsOfSystem(const std::filesystem::path& path);
  /// Lists the sockets and named pipes below a folder: programs could write to them even in a read-only mount.
  static std::vector<std::filesystem::path> PipesBelow(const std::filesystem::path& folder);
  /// Returns true if a folder is or contains a scratch folder. Programs see scratch folders empty, so such a folder
  /// cannot be mounted unchanged.
  static bool HoldsScratch(const std::filesystem::path& folder);

  bool IsUp() const { return !program_.empty(); }
  /// Returns the path of bubblewrap; "" = no fence.
  const std::string& program() const { return program_; }
  /// Returns "bubblewrap 0.8.0", or "none (…)" with the reason.
  const std::string& description() const { return description_; }

  /// Sets the number of fenced programs that run at the same time and share the kernel's limits per user.
  void ShareBy(int programs) { programs_ = programs; }
  int programs() const { return programs_; }

  /// Returns ControlGroup::FindPlace(); "" without a fence.
  const std::string& groups() const { return groups_; }
  /// Returns how the memory of programs inside is counted: "counted by the kernel (cgroup v2)", for instance.
  std::string MemoryDescription() const;

  /// Hides a path, even if it belongs to the system or to a shown folder. A hidden folder appears empty; a hidden file
  /// cannot be read.
  void Hide(const std::filesystem::path& path) { hidden_.push_back(path); }
  const std::vector<std::filesystem::path>& hidden() const { return hidden_; }
  /// Returns the system's paths that are hidden unless shown explicitly: sockets, named pipes, and, if this process is
  /// root, files that only root can read.
  const std::vector<std::filesystem::path>& kept() const { return kept_; }

  ScratchUse MeasureScratch(pid_t inside) const;

  /// Tries again to run bubblewrap. Does nothing without a fence; on failure, the error's cause is this machine.
  Result<void> Try() const;

  /// Returns the command that runs `command` (a path and arguments) inside the fence, with the working folder `start`
  /// ("" = /tmp). Besides the system, the command sees `shown`, absolute paths of files and folders. Without a fence,
  /// returns `command` unchanged.
  FencedCommand Around(const std::vector<std::string>& command, const std::vector<std::filesystem::path>& shown,
                       const std::filesystem::path& start = {}) const;

 private:
  std::string program_, groups_;
  int programs_ = 1;
  std::string description_ = "none (not asked for)";
  std::vector<std::filesystem::path> hidden_, kept_;
};

}  // namespace etude
