#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bench/outside/outside_method.h"
#include "io/files/temporary_folder.h"
#include "io/process/child_process.h"
#include "io/process/clock.h"
#include "io/process/control_group.h"
#include "io/process/tree_meter.h"

namespace etude {

/// The standard error of one program: collected in memory, so that its last line is not mixed with those of the same
/// program in other workers, and saved to a file that they share.
class ErrorLog {
 public:
  /// The largest number of bytes of the file, and of what is collected between two calls of Save.
  static constexpr long kLargest = 1 << 20;

  /// Collects output for Save, which appends it to `file`; "" collects nothing.
  explicit ErrorLog(std::string file);
  ErrorLog(const ErrorLog&) = delete;
  ErrorLog& operator=(const ErrorLog&) = delete;
  ~ErrorLog();

  /// Returns the file to open as the program's standard error; "" if it shares ours.
  std::string path() const;
  /// Drops the collected output beyond the limit, except its end.
  void Trim();
  /// Returns the last non-empty line since the last Save; "" if there is none.
  std::string LastLine() const;
  /// Appends the collected output to the file, up to its limit, and clears it. Creates the file's folder.
  void Save();

 private:
  std::string Read(long start, long size) const;
  long Size() const;

  std::string file_;
  int memory_ = -1;
  Descriptor unbuffered_;  ///< the file itself, if the system cannot make a memory file
};

/// The reason why a program gave no answer.
struct OutsideFailure {
  Status status = Status::kFailed;
  std::string reason;
  bool was_asked = true;  ///< false: this machine is the cause
};
template <typename T>
using OutsideOutcome = tl::expected<T, OutsideFailure>;
OutsideFailure TookTooLong(double seconds);

/// A program in its sandbox, read line by line, and monitored while we wait: its time, its memory, and whether it still
/// runs. One process at a time; the next one starts after the last one was stopped.
class WatchedProgram {
 public:
  /// The options must outlive this.
  explicit WatchedProgram(const OutsideOptions& options) : options_(options), errors_(options.error_file) {}

  /// Starts the program. Fails if this machine cannot.
  OutsideOutcome<void> Start();
  bool IsRunning() const { return child_.has_value(); }
  /// Closes its input, waits `patience_ms`, then kills it. Returns how it ended, or "not running".
  std::string Stop(int patience_ms);

  /// Sends a line. A program that does not read any more is noticed by the missing reply. This and the next five
  /// functions require a running program.
  void Send(const std::string& line) { child_->Send(line); }
  /// Reads the output available now; NextLine returns it line by line.
  void Receive();
  std::optional<std::string> NextLine() { return child_->NextLine(); }
  /// Waits for a whole line until `deadline`, which is `seconds` after the question. Fails with how the program ended,
  /// with the resource that it used too much of, or with its time.
  OutsideOutcome<std::string> WaitForLine(Clock::time_point deadline, double seconds);
  /// Measures its resources; fails if they exceed the limits. `LookAgain` does so unless the last measurement is
  /// recent.
  OutsideOutcome<void> Look();
  OutsideOutcome<void> LookAgain();
  /// Returns the number of bytes sent that it has not read yet.
  std::size_t UnreadBytes() const { return child_->UnreadBytes(); }

  /// The folder of attachments, which exists from the first start on.
  const std::filesystem::path& attachment_root() const { return attachment_root_->path(); }
  /// Replaces the path of the attachments' folder in a text, because it differs in every run.
  std::string WithoutFolder(std::string text) const;

  /// Returns the processor time used since the last call, as last measured, seconds.
  double TakeCpuSeconds();
  /// The largest memory measured since ForgetPeak, MB.
  double peak_mb() const { return peak_mb_; }
  void ForgetPeak() { peak_mb_ = 0; }
  /// Saves its standard error.
  void SaveErrors() { errors_.Save(); }

  /// The time that a program may take from closing its output to its end, milliseconds.
  static constexpr int kDyingMs = 1000;

 private:
  OutsideFailure HowItEnded();
  tl::unexpected<OutsideFailure> TooMuchMemory() const;

  const OutsideOptions& options_;
  ErrorLog errors_;
  std::optional<TemporaryFolder> attachment_root_;
  ControlGroup group_;  ///< of the child; empty if this machine provides none: then the meter measures its memory
  std::optional<ChildProcess> child_;
  std::optional<TreeMeter> meter_;  ///< of the child
  Clock::time_point last_look_{};
  double cpu_s_ = 0;          ///< of the running program, as last measured
  double cpu_charged_s_ = 0;  ///< the part returned by TakeCpuSeconds before
  double peak_mb_ = 0;
};

}  // namespace etude
