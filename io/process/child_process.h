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

/// The limits of an outside program, besides the time and memory that the scenario allows.
struct ProgramLimits {
  static constexpr std::uint64_t kFileBytes = std::uint64_t{256} << 20;  ///< per file; in a fence, per scratch folder
  /// The maximum number of open descriptors per process. The kernel applies the same limit to the user's descriptors in
  /// flight between processes (SCM_RIGHTS). A program can thus hold 512 pipes in flight and 256 open pipes, so that
  /// some of the user's 1024 pipes of full size are left for other programs.
  static constexpr std::uint64_t kOpenFiles = 512;
  static constexpr std::uint64_t kPendingSignals = 1024;  ///< signals and POSIX timers
  static constexpr std::uint64_t kLockedBytes = 1 << 20;  ///< memory locked by mlock
  static constexpr int kInotifyWatches = 4096;

  // The limits below are for all processes of the program together; they are sampled 50 times a second.
  static constexpr std::size_t kProcesses = 256;
  static constexpr std::size_t kThreads = 4096;
  static constexpr std::size_t kDescriptors = 4096;
  static constexpr std::size_t kSockets = 1024;  ///< sockets, which are counted only in a fence (fence.h)
  static constexpr std::size_t kFileLocks = 16384;

  // Kernel limits per user are divided among `programs`, the programs that run at the same time: half of the 128
  // inotify instances, three quarters of the 1024 pipes of full size, half of the threads.
  static int InotifyInstances(int programs) { return std::clamp(64 / programs, 1, 8); }
  static std::size_t Pipes(int programs) { return static_cast<std::size_t>(std::clamp(768 / programs, 16, 256)); }
  static std::uint64_t Threads(int programs, std::uint64_t of_user) {
    return std::clamp<std::uint64_t>(of_user / 2 / static_cast<std::uint64_t>(programs), 64, kThreads);
  }
};

/// Finds a program as a shell does: a name with '/' is a path, any other name is looked up in PATH. Fails if there is
/// no such program.
Result<std::string> FindProgram(const std::string& name);

struct ChildOptions {
  std::string program;  ///< a path, or a name that is looked up in PATH
  std::vector<std::string> arguments = {};
  std::string error_file = {};  ///< the child's standard error is appended here; "" = the child uses this process's
  bool limited = false;         ///< true for outside programs: ProgramLimits apply, no new privileges, no variable PWD
  /// Makes the child the first process of new user, PID and mount namespaces, if the kernel allows it. When the child
  /// ends (at the latest, when this process ends), the kernel ends all processes in the namespaces.
  bool contained = false;
  int programs = 1;  ///< number of outside programs that run at the same time and share the limits per user
  /// ControlGroup::folder of the group to start the child in; only if contained.
  int control_group = -1;
  std::vector<std::string> inherited_texts = {};  ///< texts that the child can read from the descriptors 3, 4, …
  /// Changes to ClosedEnvironment: NAME=VALUE sets a variable, NAME removes a variable.
  std::vector<std::string> environment = {};
};

/// Makes this process adopt orphaned descendants of its children from now on; Finish kills them. Use this only in
/// processes that start all their children by ChildProcess.
void AdoptOrphans();

/// A child process with pipes for its standard input and output, which carry lines. It runs in the closed environment
/// (ClosedEnvironment), leads a process group of its own (so a terminal's Ctrl-C does not reach it), inherits only the
/// descriptors of the options, and is killed when this process dies. The destructor kills and reaps the child and its
/// descendants. Start makes this process ignore SIGPIPE, because sending to a dead child would raise this signal.
class ChildProcess {
 public:
  /// Fails if the program cannot be found or executed, or if `error_file` cannot be written. If no process can be
  /// started, the error's cause is this machine (machine.h).
  static Result<ChildProcess> Start(const ChildOptions& options);
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&& other) noexcept;
  ~ChildProcess();

  /// Sends a line without waiting for the child: bytes that do not fit into the pipe are sent by later calls of Send
  /// and Receive. Returns false if the child has closed its input.
  bool Send(const std::string& line);
  bool HasUnsent() const { return sent_ < unsent_.size(); }
  /// Returns the number of bytes sent that the child has not read yet.
  std::size_t UnreadBytes() const;
  /// Return the descriptors for poll(). `output` becomes readable when the child has written something or closed its
  /// output; `input` becomes writable when unsent bytes fit into the pipe.
  int output() const { return output_; }
  int input() const { return input_; }
  /// Sends unsent bytes and reads up to 1 MiB of the child's output, without waiting. NextLine then returns the whole
  /// lines; take them all before the next call. Returns false if the child has closed its output, if a line is longer
  /// than `max_line_bytes`, and on errors of the pipes (broken_by).
  bool Receive(std::size_t max_line_bytes = std::size_t{1} << 30);
  std::optional<std::string> NextLine();
  /// Returns the beginning of a line whose end has not been received yet.
  std::string_view PartOfLine() const { return std::string_view(buffer_).substr(line_start_); }
  /// Returns the child's process ID; −1 after Finish.
  pid_t number() const { return pid_; }
  /// Measures the child alone; TreeMeter measures its descendants too.
  ProcessUsage MeasureAlone() const;
  /// Returns the process ID of the child's first living child; −1 if there is none.
  pid_t FirstStarted() const;
  /// Returns true if the child has ended. The child's descendants may still keep its output open.
  bool HasEnded() const;
  /// Returns the errno of a failed read or write of the pipes; 0 = none. The cause is then this machine.
  int broken_by() const { return broken_by_; }
  /// Closes the child's input, waits up to `patience_ms` for the child to end, then kills it and all its descendants.
  /// Returns how the child ended: "exit code 2", "signal 11 (Segmentation fault)". Exit code 128 + n is reported as
  /// signal n, because shells and bubblewrap report a signal in this way.
  std::string Finish(int patience_ms = 50);
  /// Returns the exit code after Finish; 128 + n if signal n ended it; −1 before Finish.
  int exit_code() const { return exit_code_; }

 private:
  ChildProcess(pid_t pid, int input, int output) : pid_(pid), input_(input), output_(output) {}
  /// Writes unsent bytes as far as the pipe takes them. Returns false if the child has closed its input.
  bool SendOn();

  pid_t pid_ = -1;
  int input_ = -1;
  int output_ = -1;
  int broken_by_ = 0;
  int exit_code_ = -1;
  std::string unsent_;
  std::size_t sent_ = 0;        ///< bytes of `unsent_` already written
  std::string buffer_;          ///< output received so far
  std::size_t line_start_ = 0;  ///< start of the next line in `buffer_`
  std::size_t scanned_ = 0;     ///< index in `buffer_`; from `line_start_` to this index there is no line end
};

}  // namespace etude
