#pragma once

#include <string>

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
  void MakeItsFolder() const;
  std::string Read(long start, long size) const;
  long Size() const;

  std::string file_;
  int memory_ = -1;
};

}  // namespace etude
