#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/process/process_tree.h"
#include "engine/base/result.h"

namespace etude {

struct ChildOptions {
  std::string program;  ///< a path, or a name to be found in PATH
  std::vector<std::string> arguments = {};
  std::string error_file = {};  ///< its standard error is appended here; "" = it shares ours
  bool limited = false;         ///< it is not ours: it gains no privileges and is kept within ProgramLimits
};

/// From now on what a child leaves behind becomes a child of this process, which ends it with the child. For processes
/// whose only children are those of ChildProcess.
void AdoptOrphans();

/// A child that is spoken to in lines: its standard input and output are ours. It runs in the pinned
/// environment, leads a process group of its own (a terminal's Ctrl-C does not reach it), inherits no other
/// files, and dies with us. Killed, with all that it has started, and reaped by the destructor.
/// Starting one makes this process ignore SIGPIPE, so that sending to a dead child is no crash of ours.
class ChildProcess {
 public:
  /// Fails when the program cannot be found or executed, or `error_file` not be written.
  static Result<ChildProcess> Start(const ChildOptions& options);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

  /// Sends a line without ever waiting for the child: what the pipe does not take now is sent by later
  /// calls of Receive and Send. False when the child no longer listens.
  bool Send(const std::string& line);
  bool HasUnsent() const { return sent_ < unsent_.size(); }
  /// For poll(): `output` is readable when the child has said something or ended; `input` is writable when
  /// something unsent can be sent on.
  int output() const { return output_; }
  int input() const { return input_; }
  /// Takes some of what can be read now (poll says whether there is more) and sends on what is unsent. Whole
  /// lines are then given by NextLine: take them all before the next call. False when the child has closed its
  /// output, that is, ended, or when a line grows beyond `longest_line` bytes.
  bool Receive(std::size_t longest_line = std::size_t{1} << 30);
  std::optional<std::string> NextLine();
  /// What has been read of a line that is not whole yet.
  std::string_view PartOfLine() const { return std::string_view(buffer_).substr(line_start_); }
  /// What it and its descendants use now; zeros when it has ended.
  ProcessUsage Measure() const;
  /// The same of the child alone.
  ProcessUsage MeasureAlone() const;
  /// Whether the program itself has ended; what it has started may still hold its output open.
  bool HasEnded() const;
  /// Ends its input, gives it `patience_ms` to end by itself, then kills it; kills what it has started either
  /// way. Says how it ended: "exit code 2", "signal 11 (Segmentation fault)"; the latter also of exit code 139, by
  /// which shells and fences tell it.
  std::string Finish(int patience_ms = 50);

 private:
  ChildProcess(pid_t pid, int input, int output) : pid_(pid), input_(input), output_(output) {}
  /// Writes what is unsent as far as the pipe takes it; false when nobody listens.
  bool SendOn();

  pid_t pid_ = -1;
  int input_ = -1;
  int output_ = -1;
  std::string unsent_;
  std::size_t sent_ = 0;  ///< bytes of `unsent_` that are already gone
  std::string buffer_;
  std::size_t line_start_ = 0;  ///< before this, the buffer has been given away
  std::size_t scanned_ = 0;     ///< from line_start_ to here the buffer is known to hold no line end
};

}  // namespace etude
