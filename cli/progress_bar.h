#pragma once

#include <string>

#include "bench/run/run.h"
#include "cli/interrupt.h"
#include "engine/base/progress.h"
#include "io/drawing/film.h"
#include "io/process/clock.h"

namespace etude {

/// Shows the progress of a run or other work on standard error: on a terminal it is redrawn in place; in a log it is
/// printed at every tenth of the work, and after 2 s, 4 s, 8 s, …, at least every minute.
class ProgressBar {
 public:
  enum class Begins {
    kAtOnce,
    kWhenItTakesLong,  ///< soon on a terminal; in a log only if the work takes so long that somebody may read the log
  };
  explicit ProgressBar(Begins begins = Begins::kAtOnce);
  /// Shows the progress of a run: of its cells, then, if it takes long, of writing its results.
  void Show(const Progress& progress);
  /// Shows the progress; `share` is 0…1.
  void Show(double share, const std::string& what, const std::string& remaining = "");

 private:
  bool IsTooSoon(double share) const;

  bool is_terminal_;
  Begins begins_;
  Clock::time_point began_ = Clock::now();
  bool is_shown_ = false;
  int tenths_shown_ = -1;
  /// For logs: the time of the next line, unless a tenth is reached before; the pause after it.
  double next_s_ = 2, pause_s_ = 2;
  bool is_writing_ = false;  ///< shows the writing of a run's results
};

/// Returns a callback that shows the progress of some work and the estimated remaining time ("12/300 clips, about 40 s
/// to go") once the work takes long.
OnProgress ProgressOf(std::string what);

/// Returns a watch that shows for each film the number of frames drawn and the estimated remaining time, and that
/// Ctrl-C stops. `jobs` processes draw; 0 = one per processor.
FilmWatch WatchFilms(const Interrupt& interrupt, int jobs = 0);

}  // namespace etude
