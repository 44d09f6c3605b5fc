#pragma once

#include <string>

#include "bench/run/run.h"
#include "cli/interrupt.h"
#include "engine/base/progress.h"
#include "io/drawing/film.h"
#include "io/process/clock.h"

namespace etude {

/// A line on standard error that says how far a run, or other work, has come: redrawn on a terminal, else printed
/// at every tenth of the way.
class ProgressBar {
 public:
  enum class Begins {
    kAtOnce,
    kWhenItTakesLong,  ///< on a terminal soon, else where it takes so long that somebody may look into a log
  };
  explicit ProgressBar(Begins begins = Begins::kAtOnce);
  void Show(const Progress& progress);
  /// Shows how far the work is: `share` is 0…1.
  void Show(double share, const std::string& what, const std::string& remaining = "");

 private:
  bool IsTooSoon(double share) const;

  bool is_terminal_;
  Begins begins_;
  Clock::time_point began_ = Clock::now();
  bool is_shown_ = false;
  int tenths_shown_ = -1;
};

/// Makes a callback that shows how far some work is, and how long the rest may take ("12/300 clips, about 40 s to go"),
/// once it takes long.
OnProgress ProgressOf(std::string what);

/// Makes a watch that shows of each film how many of its frames are drawn and how long the rest may take, and that
/// Ctrl-C stops. `jobs` processes draw; 0 = one per processor.
FilmWatch WatchFilms(const Interrupt& interrupt, int jobs = 0);

}  // namespace etude
