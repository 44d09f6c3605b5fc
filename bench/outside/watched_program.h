#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "bench/outside/outside_method.h"
#include "bench/outside/program_view.h"
#include "io/files/temporary_folder.h"
#include "io/process/child_process.h"
#include "io/process/clock.h"
#include "io/process/control_group.h"
#include "io/process/tree_meter.h"

namespace etude {

/// Collects the standard error of one program in memory, and saves it to a file that all workers share. The memory
/// contains only this program's lines, while the file mixes the lines of all workers.
class ErrorLog {
 public:
  /// The largest size of the file, bytes. Output beyond this size is not saved.
  static constexpr long kMaxBytes = 1 << 20;

  /// Save appends the collected output to `file`. If `file` is "", nothing is collected.
  explicit ErrorLog(std::string file);
  ErrorLog(const ErrorLog&) = delete;
  ErrorLog& operator=(const ErrorLog&) = delete;
  ~ErrorLog();

  /// Returns the path that must be opened as the program's standard error; "" if the program shares Etude's standard
  /// error.
  std::string path() const;
  /// Frees the memory of collected output beyond kMaxBytes. The last 4 KiB are kept for LastLine.
  void Trim();
  /// Returns the last non-empty line since the last Save; "" if there is none.
  std::string LastLine() const;
  /// Appends the collected output to the file, up to kMaxBytes, and then discards it. Creates the file's folder.
  void Save();

 private:
  std::string Read(long start, long size) const;
  std::string Tail() const;  ///< the last 4 KiB of the output, or all of it if it is shorter
  long Size() const;

  std::string file_;
  int memory_ = -1;
  std::string kept_tail_;  ///< the last 4 KiB before the last truncation; "" if the file was not truncated
  Descriptor unbuffered_;  ///< the log file itself, if the system cannot make a memory file
};

/// The reason why a program gave no answer.
struct OutsideFailure {
  Status status = Status::kFailed;
  std::string reason;
  bool was_asked = true;  ///< false: this machine, not the program, is the cause
};
template <typename T>
using OutsideOutcome = tl::expected<T, OutsideFailure>;
OutsideFailure TookTooLong(double seconds);

/// An outside program in its sandbox. While Etude waits for a line, it monitors the program's time, memory and end. The
/// program may be started again after Stop.
class WatchedProgram {
 public:
  /// The options must outlive this object.
  explicit WatchedProgram(const OutsideOptions& options) : options_(options), errors_(options.error_file) {}

  /// Starts the program. Fails if this machine cannot start it.
  OutsideOutcome<void> Start();
  bool IsRunning() const { return child_.has_value(); }
  /// Closes the program's input, waits up to `patience_ms` for the program to end, then kills it. Returns how the
  /// program ended, or "not running".
  std::string Stop(int patience_ms);

  /// Sends a line. If the program has closed its input, the next WaitForLine fails. The functions from Send to
  /// UnreadBytes require a running program.
  void Send(const std::string& line) { child_->Send(line); }
  /// Reads the output that is available now. NextLine then returns its lines.
  void Receive();
  std::optional<std::string> NextLine() { return child_->NextLine(); }
  /// Waits for a line until `deadline`. Fails if the program ends, exceeds the limit of a resource, or sends no line in
  /// time; in the last case, the error message states the time limit `seconds`, counted from the question.
  OutsideOutcome<std::string> WaitForLine(Clock::time_point deadline, double seconds);
  /// Measures the program's resources. Fails if they exceed the limits. MeasureIfDue measures only if 20 ms have passed
  /// since the last sample.
  OutsideOutcome<void> Measure();
  OutsideOutcome<void> MeasureIfDue();
  /// Measures the program's resources until the program waits, writes something or has ended, or has computed for 50
  /// ms.
  OutsideOutcome<void> Rest();
  /// Reads the output that is available now. Fails if this is a part of a line, or if the program will send no more.
  OutsideOutcome<void> ReadRest();
  /// Returns the number of bytes that were sent to the program and that the program has not read yet.
  std::size_t UnreadBytes() const { return child_->UnreadBytes(); }

  /// Returns the folder that holds the folders of attachments. Start makes it, so Start must have been called.
  const std::filesystem::path& attachment_root() const { return attachment_root_->path(); }
  /// Returns a text in which "FILES" replaces the path of the attachments' folder, because this path differs in every
  /// run.
  std::string WithoutFolder(std::string text) const;

  /// Returns the program's processor time since the previous call, seconds, as far as samples have measured it.
  double TakeCpuSeconds();
  /// Returns the largest memory measured since ForgetPeak, MB.
  double peak_mb() const { return peak_mb_; }
  void ForgetPeak() { peak_mb_ = 0; }
  /// Returns advice on how to show the program the files that it seems to lack in its sandbox; "" if it seems to lack
  /// none or has no sandbox.
  std::string AdviceOnStartFailure() const;
  /// Saves the program's standard error.
  void SaveErrors() { errors_.Save(); }

  /// The time within which a program must end after it has closed its output, milliseconds.
  static constexpr int kMaxDyingMs = 1000;

 private:
  OutsideFailure HowItEnded();
  bool HasClosedOutput();
  /// The number of processes at the root of the child's tree that belong to the fence: bubblewrap and the first
  /// process.
  std::size_t FenceProcesses() const { return options_.fence.IsUp() ? 2 : 0; }
  std::string StartOfLine() const;  ///< of the line whose end has not been received yet
  tl::unexpected<OutsideFailure> TooMuchMemory() const;

  const OutsideOptions& options_;
  ErrorLog errors_;
  std::optional<TemporaryFolder> attachment_root_;
  ProgramView view_;    ///< what the sandbox shows the child, apart from attachments and the Python package
  ControlGroup group_;  ///< the child's group; if this machine provides none, `meter_` measures the memory
  std::optional<ChildProcess> child_;
  std::optional<TreeMeter> meter_;  ///< measures the child and the child's own processes
  Clock::time_point last_measured_{};
  double cpu_s_ = 0;          ///< processor time of the running program at the last sample
  double cpu_charged_s_ = 0;  ///< the part of cpu_s_ that TakeCpuSeconds has already returned
  double peak_mb_ = 0;
  TreeLoad load_;           ///< the last sample
  int samples_closed_ = 0;  ///< number of successive samples in which no process inside the fence held the output
};

}  // namespace etude
