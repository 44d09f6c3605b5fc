#pragma once

#include "reports/films/film.h"
#include "reports/films/transition_race.h"

namespace etude {

/// Which moment of a request is seen at which frame of a film, the same for every method: from a second before the
/// request until after the last transition, and then all once more, slower. Times are frames after the request.
class TransitionClock {
 public:
  static constexpr int kSlowness = 4;

  explicit TransitionClock(const TransitionRace& race);

  int First() const { return first_; }
  int Last() const { return last_; }
  int Frames() const { return Run() + kRest + kSlowness * (slow_last_ - slow_first_ + 1) + kRest; }
  int TimeAt(int frame) const;
  bool IsSlow(int frame) const { return frame >= Run() + kRest; }
  /// The frame of the film that first shows this moment.
  int FrameOf(int time) const;

 private:
  static constexpr int kRest = kFilmRate / 2;

  int Run() const { return last_ - first_ + 1; }

  int first_, last_;
  int slow_first_, slow_last_;
};

}  // namespace etude
