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

/// Collects the standard error of one program in memory, and saves it to a file that all workers share. The last line
/// in memory is always this program's own, while the file mixes lines of all workers.
class ErrorLog {
 public:
  /// The maximum size of the file, and of the output kept between two calls of Save.
  static constexpr long kMaxBytes = 1 << 20;

  /// Collects output for Save, which appends it to `file`; "" collects nothing.
  explicit ErrorLog(std::string file);
  ErrorLog(const ErrorLog&) = delete;
  ErrorLog& operator=(const ErrorLog&) = delete;
  ~ErrorLog();

  /// Returns the path to open as the program's standard error; "" if it shares ours.
  std::string path() const;
  /// Discards collected output beyond the limit, except its end.
  void Trim();
  /// Returns the last non-empty line since the last Save; "" if there is none.
  std::string LastLine() const;
  /// Appends the collected output to the file, up to kMaxBytes, and clears it. Creates the file's folder.
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

/// An outside program in its sandbox. While we wait for a line, its time, its memory and its end are monitored. It may
/// be started again after Stop.
class WatchedProgram {
 public:
  /// The options must outlive this.
  explicit WatchedProgram(const OutsideOptions& options) : options_(options), errors_(options.error_file) {}

  /// Starts the program. Fails if this machine cannot.
  OutsideOutcome<void> Start();
  bool IsRunning() const { return child_.has_value(); }
  /// Closes its input, waits `patience_ms`, then kills it. Returns how it ended, or "not running".
  std::string Stop(int patience_ms);

  /// Sends a line. If the program has closed its input, WaitForLine fails. This and the next five functions require a
  /// running program.
  void Send(const std::string& line) { child_->Send(line); }
  /// Reads the output available now; NextLine returns its lines.
  void Receive();
  std::optional<std::string> NextLine() { return child_->NextLine(); }
  /// Waits for a line until `deadline`, which is `seconds` after the question. Fails if the program ends, exceeds the
  /// limit of a resource, or sends no line in time.
  OutsideOutcome<std::string> WaitForLine(Clock::time_point deadline, double seconds);
  /// Measures its resources; fails if they exceed the limits. MeasureIfDue does so only 20 ms after the last sample.
  OutsideOutcome<void> Measure();
  OutsideOutcome<void> MeasureIfDue();
  /// Returns the number of bytes sent that it has not read yet.
  std::size_t UnreadBytes() const { return child_->UnreadBytes(); }

  /// The folder of attachments, which exists from the first start on.
  const std::filesystem::path& attachment_root() const { return attachment_root_->path(); }
  /// Replaces the path of the attachments' folder by "FILES" in a text, because the path differs in every run.
  std::string WithoutFolder(std::string text) const;

  /// Returns the processor time between the last samples before this call and before the previous one, seconds.
  double TakeCpuSeconds();
  /// Returns the largest memory measured since ForgetPeak, MB.
  double peak_mb() const { return peak_mb_; }
  void ForgetPeak() { peak_mb_ = 0; }
  /// Returns how to show the program what it seems to lack in its fence; "" if nothing is known to be missing.
  std::string CureOfStart() const;
  /// Saves its standard error.
  void SaveErrors() { errors_.Save(); }

  /// The time in which a program must end after closing its output, milliseconds.
  static constexpr int kMaxDyingMs = 1000;

 private:
  OutsideFailure HowItEnded();
  tl::unexpected<OutsideFailure> TooMuchMemory() const;

  const OutsideOptions& options_;
  ErrorLog errors_;
  std::optional<TemporaryFolder> attachment_root_;
  ProgramView view_;    ///< of the child, without attachments and package
  ControlGroup group_;  ///< of the child; if this machine provides none, `meter_` measures the memory
  std::optional<ChildProcess> child_;
  std::optional<TreeMeter> meter_;  ///< of the child
  Clock::time_point last_measured_{};
  double cpu_s_ = 0;          ///< of the running program, as last measured
  double cpu_charged_s_ = 0;  ///< the part returned by TakeCpuSeconds before
  double peak_mb_ = 0;
};

}  // namespace etude
