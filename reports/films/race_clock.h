#pragma once

#include "reports/films/film.h"

namespace etude {

/// Which iteration is seen at which frame of a film, the same for every method: a fair race. Time is a logarithm,
/// each frame multiplies iteration + 1 by the same factor: the first steps, which change most, are seen one by one, the
/// last ones pass quickly. The start and the end are held for a while.
class RaceClock {
 public:
  /// For films of methods of which the longest takes `last_iteration` ≥ 0 steps: 6 to 10 seconds.
  explicit RaceClock(int last_iteration);

  int LastIteration() const { return last_; }
  int Frames() const { return kOpening + run_ + kEnding; }
  /// 0 … the last one, never falling; the fraction is the time within an iteration.
  double IterationAt(int frame) const;
  /// 0…1: where an iteration lies on an axis that the clock crosses at constant speed.
  double ShareOf(double iteration) const;

 private:
  static constexpr int kOpening = kFilmRate / 2, kEnding = 3 * kFilmRate / 2;

  int last_;
  int run_;  ///< frames between opening and ending
};

}  // namespace etude
