#pragma once

#include "bench/run/run.h"

namespace etude {

/// A line on standard error that says how far a run has come: redrawn on a terminal, else printed at
/// every tenth of the way.
class ProgressBar {
 public:
  ProgressBar();
  void Show(const Progress& progress);

 private:
  bool is_terminal_;
  int tenths_shown_ = -1;
};

}  // namespace etude
