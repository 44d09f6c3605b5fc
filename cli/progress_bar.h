#pragma once

#include <string>

#include "bench/run/run.h"

namespace etude {

/// A line on standard error that says how far a run, or other work, has come: redrawn on a terminal, else printed
/// at every tenth of the way.
class ProgressBar {
 public:
  ProgressBar();
  void Show(const Progress& progress);
  /// `share` of the way, 0 … 1; `remaining` is told where there is somebody who waits.
  void Show(double share, const std::string& what, const std::string& remaining = "");

 private:
  bool is_terminal_;
  int tenths_shown_ = -1;
};

}  // namespace etude
