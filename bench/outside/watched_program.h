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

/// The standard error of one program: collected in memory, so that its last words can be told from those of its
/// twins in other workers, and saved to a file that they share.
class ErrorLog {
 public:
  /// Bytes of the file, and of what is collected between two calls of Save.
  static constexpr long kLargest = 1 << 20;

  /// Collects for Save, which appends to `file`; "" collects nothing.
  explicit ErrorLog(std::string file);
  ErrorLog(const ErrorLog&) = delete;
  ErrorLog& operator=(const ErrorLog&) = delete;
  ~ErrorLog();

  /// Names the file that the program's standard error is to be opened as; "" when it shares ours.
  std::string path() const;
  /// Forgets what has been said beyond the limit, but for its end.
  void Trim();
  /// Gives the last line that is not empty of what was said since the last Save; "" when there is none.
  std::string LastLine() const;
  /// Appends what was said to the file, up to its limit, and forgets it. Makes the folder that the file is in.
  void Save();

 private:
  std::string Read(long start, long size) const;
  long Size() const;

  std::string file_;
  int memory_ = -1;
  Descriptor unbuffered_;  ///< the file itself, where the system makes no file in memory
};

/// The reason why a program gave no answer.
struct OutsideFailure {
  Status status = Status::kFailed;
  std::string reason;
  bool was_asked = true;  ///< false: something of this machine is to blame
};
template <typename T>
using OutsideOutcome = tl::expected<T, OutsideFailure>;
OutsideFailure TookTooLong(double seconds);

/// A program behind its fence, heard line by line, and watched while it is waited for: how long it takes, how much it
/// holds, whether it still runs. One process at a time; a new one is started after the last one was stopped.
class WatchedProgram {
 public:
  /// The options must outlive this.
  explicit WatchedProgram(const OutsideOptions& options) : options_(options), errors_(options.error_file) {}

  /// Starts the program. Fails when this machine cannot.
  OutsideOutcome<void> Start();
  bool IsRunning() const { return child_.has_value(); }
  /// Ends its input, gives it `patience_ms`, then kills it; says how it ended, or "not running".
  std::string Stop(int patience_ms);

  /// Sends a line; a program that no longer listens is noticed by its silence. The next five only while it runs.
  void Send(const std::string& line) { child_->Send(line); }
  /// Takes what can be read now; NextLine gives it, line by line.
  void Receive();
  std::optional<std::string> NextLine() { return child_->NextLine(); }
  /// Waits for a whole line until `deadline`, which is `seconds` after the question. Fails with how the program ended,
  /// with what it used too much of, or by its time.
  OutsideOutcome<std::string> WaitForLine(Clock::time_point deadline, double seconds);
  /// Notes what it uses; fails when that is too much. `LookAgain` does so unless the last look was just now.
  OutsideOutcome<void> Look();
  OutsideOutcome<void> LookAgain();
  /// The bytes sent that it has not read yet.
  std::size_t UnreadBytes() const { return child_->UnreadBytes(); }

  /// The folder where attachments lie, from the first start on.
  const std::filesystem::path& attachment_root() const { return attachment_root_->path(); }
  /// Replaces the folder of attachments in a text: it is another one at every run.
  std::string WithoutFolder(std::string text) const;

  /// Returns the processor time that it has used since the last call, as last seen, seconds.
  double TakeCpuSeconds();
  /// The most memory seen since ForgetPeak, MB.
  double peak_mb() const { return peak_mb_; }
  void ForgetPeak() { peak_mb_ = 0; }
  /// Saves what it said on its standard error.
  void SaveErrors() { errors_.Save(); }

  /// The time that a program may take from closing its output to its end, milliseconds.
  static constexpr int kDyingMs = 1000;

 private:
  OutsideFailure HowItEnded();
  tl::unexpected<OutsideFailure> TooMuchMemory() const;

  const OutsideOptions& options_;
  ErrorLog errors_;
  std::optional<TemporaryFolder> attachment_root_;
  ControlGroup group_;  ///< of the child; none where this machine gives none: then the meter counts its memory
  std::optional<ChildProcess> child_;
  std::optional<TreeMeter> meter_;  ///< of the child
  Clock::time_point last_look_{};
  double cpu_s_ = 0;          ///< of the running program, as last seen
  double cpu_charged_s_ = 0;  ///< of that, taken before
  double peak_mb_ = 0;
};

}  // namespace etude
