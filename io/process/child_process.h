#pragma once

#include <sys/types.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "io/process/process_tree.h"

namespace etude {

/// The limits of a program that is not ours, beside the time and memory that a scenario allows it.
struct ProgramLimits {
  static constexpr std::uint64_t kFileBytes = std::uint64_t{256} << 20;  ///< of a file; in a fence, of a scratch folder
  /// Of one process. Files that are on their way between processes can be as many, in all of a user's programs: so
  /// many pipes and another 256 leave all others of the user some of the 1024 pipes of full size that the kernel
  /// allows.
  static constexpr std::uint64_t kOpenFiles = 512;
  static constexpr std::uint64_t kPendingSignals = 1024;  ///< and timers
  static constexpr std::uint64_t kLockedBytes = 1 << 20;  ///< kept from being swapped out
  static constexpr int kInotifyWatches = 4096;

  // Of all its processes, as looked at 50 times a second.
  static constexpr std::size_t kProcesses = 256;
  static constexpr std::size_t kThreads = 4096;
  static constexpr std::size_t kDescriptors = 4096;
  static constexpr std::size_t kSockets = 1024;  ///< in a fence
  static constexpr std::size_t kFileLocks = 16384;

  // What the kernel counts by user is shared by the programs that run at the same time: half of the 128 inotify
  // instances, three quarters of the 1024 pipes of full size, half of the threads that the user may have.
  static int InotifyInstances(int programs) { return std::clamp(64 / programs, 1, 8); }
  static std::size_t Pipes(int programs) { return static_cast<std::size_t>(std::clamp(768 / programs, 16, 256)); }
  static std::uint64_t Threads(int programs, std::uint64_t of_user) {
    return std::clamp<std::uint64_t>(of_user / 2 / static_cast<std::uint64_t>(programs), 64, kThreads);
  }
};

/// The path of a program, the way a shell finds it.
Result<std::string> FindProgram(const std::string& name);

struct ChildOptions {
  std::string program;  ///< a path, or a name to be found in PATH
  std::vector<std::string> arguments = {};
  std::string error_file = {};  ///< its standard error is appended here; "" = it shares ours
  bool limited = false;  ///< it is not ours: it gains no privileges, is kept within ProgramLimits, not told our folder
  /// It is the first process of a space of its own, where the kernel grants one: with it, and it goes with us, end all
  /// that it has started, whatever they were at.
  bool contained = false;
  int programs = 1;                    ///< such as this one, that run at the same time
  int control_group = -1;              ///< ControlGroup::folder of the one that it starts in, if it is contained
  std::vector<std::string> told = {};  ///< what it can read from its descriptors 3, 4, …
  /// Changes to the closed environment: NAME=VALUE sets a variable, NAME removes one.
  std::vector<std::string> environment = {};
};

/// Makes what a child leaves behind from now on a child of this process, which ends it with the child. For processes
/// whose only children are those of ChildProcess.
void AdoptOrphans();

/// A child that is spoken to in lines: its standard input and output are ours. It runs in the pinned
/// environment, leads a process group of its own (a terminal's Ctrl-C does not reach it), inherits no other
/// files than those asked for, and dies with us. Killed, with all that it has started, and reaped by the destructor.
/// Starting one makes this process ignore SIGPIPE, so that sending to a dead child is no crash of ours.
class ChildProcess {
 public:
  /// Fails when the program cannot be found or executed, or `error_file` not be written; when no process can be
  /// started, with an error of this machine (machine.h).
  static Result<ChildProcess> Start(const ChildOptions& options);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

  /// Sends a line without ever waiting for the child: what the pipe does not take now is sent by later
  /// calls of Receive and Send. False when the child no longer listens.
  bool Send(const std::string& line);
  bool HasUnsent() const { return sent_ < unsent_.size(); }
  /// The bytes sent that the child has not read yet.
  std::size_t UnreadBytes() const;
  /// The descriptors for poll(): `output` is readable when the child has said something or ended; `input` is writable
  /// when something unsent can be sent on.
  int output() const { return output_; }
  int input() const { return input_; }
  /// Takes some of what can be read now (poll says whether there is more) and sends on what is unsent. Whole
  /// lines are then given by NextLine: take them all before the next call. False when the child has closed its
  /// output, that is, ended, when a line grows beyond `longest_line` bytes, and when it cannot be talked to any more.
  bool Receive(std::size_t longest_line = std::size_t{1} << 30);
  std::optional<std::string> NextLine();
  /// The beginning of a line that has not been read to its end yet.
  std::string_view PartOfLine() const { return std::string_view(buffer_).substr(line_start_); }
  /// The number of its process; -1 when it has been finished.
  pid_t number() const { return pid_; }
  /// The usage of the child alone, without its descendants (TreeMeter).
  ProcessUsage MeasureAlone() const;
  /// The first process that the child has started and that is there; -1 when there is none.
  pid_t FirstStarted() const;
  /// True if the program itself has ended; what it has started may still hold its output open.
  bool HasEnded() const;
  /// The errno by which this machine keeps us from talking to it; 0 = it does not.
  int broken_by() const { return broken_by_; }
  /// Ends its input, gives it `patience_ms` to end by itself, then kills it; kills what it has started either
  /// way. Says how it ended: "exit code 2", "signal 11 (Segmentation fault)"; the latter also of exit code 139, by
  /// which shells and fences tell it.
  std::string Finish(int patience_ms = 50);
  /// The exit code of a finished child; of one that a signal ended, 128 and its number. −1 before it is finished.
  int exit_code() const { return exit_code_; }

 private:
  ChildProcess(pid_t pid, int input, int output) : pid_(pid), input_(input), output_(output) {}
  /// Writes what is unsent as far as the pipe takes it; false when nobody listens.
  bool SendOn();

  pid_t pid_ = -1;
  int input_ = -1;
  int output_ = -1;
  int broken_by_ = 0;
  int exit_code_ = -1;
  std::string unsent_;
  std::size_t sent_ = 0;  ///< bytes of `unsent_` that are already gone
  std::string buffer_;
  std::size_t line_start_ = 0;  ///< before this, the buffer has been given away
  std::size_t scanned_ = 0;     ///< from line_start_ to here the buffer is known to hold no line end
};

}  // namespace etude
