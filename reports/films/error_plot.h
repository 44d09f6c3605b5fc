#pragma once

#include <string>
#include <vector>

#include "reports/films/canvas.h"
#include "reports/films/race_clock.h"

namespace etude {

/// One method's error: `values` at `iterations`.
struct ErrorCurve {
  std::vector<int> iterations;
  std::vector<double> values;
  Paint colour;
};

/// Errors along iterations, both axes logarithmic, that draw themselves as time goes.
class ErrorPlot {
 public:
  /// `suffix`: put behind a value, " cm". `goal` > 0 is drawn as a line. Every curve has a value; without
  /// curves there is nothing but the title.
  ErrorPlot(std::string title, std::string suffix, double goal, std::vector<ErrorCurve> curves, const RaceClock& clock);

  /// As far as the curves are known at `iteration`.
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
