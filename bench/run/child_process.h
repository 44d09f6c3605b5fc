#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"

namespace etude {

/// The settings under which the same build gives the same bytes on any machine (design.md §6). They
/// must stand before a process starts, which is why work is done in child processes.
const std::vector<std::string>& PinnedEnvironment();

/// A child that is spoken to in lines: its standard input and output are ours, its standard error is
/// the terminal's. It dies with us. Killed and reaped by the destructor.
class ChildProcess {
 public:
  /// Starts `program` with `arguments` in the pinned environment.
  static Result<ChildProcess> Start(const std::string& program, const std::vector<std::string>& arguments);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

  /// Sends a line; false when the child no longer listens.
  bool Send(const std::string& line);
  /// For poll(): readable when the child has said something or ended.
  int output() const { return output_; }
  /// Takes what can be read now. Whole lines are then given by NextLine. False when the child has
  /// closed its output, that is, ended.
  bool Receive();
  std::optional<std::string> NextLine();
  /// Kills it if it still runs, and says how it ended: "exit code 2", "signal 11 (Segmentation fault)".
  std::string Finish();

 private:
  ChildProcess(pid_t pid, int input, int output) : pid_(pid), input_(input), output_(output) {}

  pid_t pid_ = -1;
  int input_ = -1;
  int output_ = -1;
  std::string buffer_;
  std::size_t scanned_ = 0;  ///< up to here the buffer is known to hold no line end
};

}  // namespace etude
