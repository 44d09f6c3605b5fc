#pragma once

#include <string>

#include "bench/run/run.h"
#include "cli/interrupt.h"
#include "engine/base/progress.h"
#include "io/drawing/film.h"
#include "io/process/clock.h"
#include "tools/listener.h"

namespace etude {

/// Shows the progress of a run or of other work on standard error. On a terminal the bar is redrawn in place. In a log,
/// a line is printed at every tenth of the work, and after 2 s, 4 s, 8 s, …, at least every minute.
class ProgressBar {
 public:
  enum class Begins {
    kAtOnce,
    /// The bar appears soon on a terminal; in a log, it appears only if the work takes so long that somebody may look
    /// into the log.
    kWhenItTakesLong,
  };
  explicit ProgressBar(Begins begins = Begins::kAtOnce);
  /// Shows the progress of a run: first of the run's cells, then of writing the results, if the writing takes long.
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
  /// For logs, in seconds: the time at which a line is due, even if the work has not reached its next tenth, and the
  /// time from that line until another one is due.
  double next_s_ = 2, pause_s_ = 2;
  bool is_writing_ = false;  ///< true while the bar shows the writing of a run's results
};

/// Returns a callback that shows the progress of some work and the estimated remaining time, as soon as the work takes
/// long: "12/300 clips, about 40 s to go".
OnProgress ProgressOf(std::string what);

/// Returns a watch that shows for each film the number of drawn frames and the estimated remaining time. Ctrl-C stops
/// the film. `jobs` processes draw; 0 = one per processor.
FilmWatch WatchFilms(const Interrupt& interrupt, int jobs = 0);

/// Returns a listener that prints to standard output and shows progress on standard error. With this listener, Ctrl-C
/// stops the writing of a film.
Listener TerminalListener();

}  // namespace etude
