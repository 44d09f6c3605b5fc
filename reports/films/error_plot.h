#pragma once

#include <string>
#include <vector>

#include "reports/films/canvas.h"
#include "reports/films/film.h"

namespace etude {

/// A clock that says which iteration is seen at which frame of a film, the same for every method. Time is a logarithm,
/// each frame multiplies iteration + 1 by the same factor: the first steps, which change most, are seen one by one, the
/// last ones pass quickly. Start and end are held for a while.
class RaceClock {
 public:
  /// Makes a clock for films of methods of which the longest takes `last_iteration` ≥ 0 steps: 6 to 10 seconds.
  explicit RaceClock(int last_iteration);

  int LastIteration() const { return last_; }
  int Frames() const { return kOpening + run_ + kEnding; }
  /// Gives the iteration at a frame, 0 … the last one, never falling; the fraction is the time within an iteration.
  double IterationAt(int frame) const;
  /// Gives the place of an iteration, 0…1, on an axis that the clock crosses at constant speed.
  double ShareOf(double iteration) const;

 private:
  static constexpr int kOpening = kFilmRate / 2, kEnding = 3 * kFilmRate / 2;

  int last_;
  int run_;  ///< frames between opening and ending
};

/// One method's error: `values` at `iterations`.
struct ErrorCurve {
  std::vector<int> iterations;
  std::vector<double> values;
  Paint colour;
};

/// A plot of errors along iterations, both axes logarithmic, that draws itself as time goes.
class ErrorPlot {
 public:
  /// Plots errors with `suffix` behind a value, " cm", and `goal` > 0 as a line. Every curve has a value; without
  /// curves there is nothing but the title.
  ErrorPlot(std::string title, std::string suffix, double goal, std::vector<ErrorCurve> curves, const RaceClock& clock);

  /// Draws the curves as far as they are known at `iteration`.
  void Draw(Canvas& canvas, const Box& panel, double iteration) const;

 private:
  struct Frame;
  void DrawValueAxis(Canvas& canvas, const Frame& frame) const;
  void DrawIterationAxis(Canvas& canvas, const Frame& frame) const;
  void DrawCurve(Canvas& canvas, const Frame& frame, const ErrorCurve& curve, double iteration, double width) const;

  std::string title_, suffix_;
  double goal_;
  std::vector<ErrorCurve> curves_;
  RaceClock clock_;
  int lowest_ = 0, highest_ = 0;  ///< decades at the lower and upper edge
};

}  // namespace etude
