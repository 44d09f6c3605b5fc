#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace etude {

/// A fence around programs that are not ours, made by bubblewrap where the kernel lets it: user, process, mount, ipc
/// and network namespaces of their own, no capabilities, a read-only view of the system, and scratch folders that go
/// with them (docs/outside-methods.md).
class Fence {
 public:
  /// No fence: programs run as we do.
  Fence() = default;
  /// The fence that this machine allows, tried once; else none, and `description` says why.
  static Fence Find();
  /// The fence that another process has found: its `program`.
  static Fence Of(const std::string& program);

  bool IsUp() const { return !program_.empty(); }
  /// The path of bubblewrap; "" = no fence.
  const std::string& program() const { return program_; }
  /// "bubblewrap 0.8.0"; "none (not asked for)".
  const std::string& description() const { return description_; }

  /// Has programs inside see `folder` empty. It must exist when they start.
  void Hide(const std::filesystem::path& folder) { hidden_.push_back(folder); }
  const std::vector<std::filesystem::path>& hidden() const { return hidden_; }

  /// The words that run `command`, a path and arguments, inside; `command` itself without a fence. Of the folders for
  /// temporary files it sees `shown`, what holds our working folder, and the files that it names.
  std::vector<std::string> Around(const std::vector<std::string>& command,
                                  const std::vector<std::filesystem::path>& shown) const;

 private:
  std::string program_;
  std::string description_ = "none (not asked for)";
  std::vector<std::filesystem::path> hidden_;
};

}  // namespace etude
