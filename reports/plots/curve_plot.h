#pragma once

#include <string>
#include <vector>

#include "io/drawing/panel.h"

namespace etude {

struct PlotCurve {
  std::size_t style = 0;  ///< index of the method that gives the colour and dashes
  bool faint = false;
  std::vector<double> values;   ///< each 0 or more
  std::vector<double> at = {};  ///< position of each value on the horizontal axis; empty: 0, 1, 2, …
};

/// Axes that neighbouring panels share, so that their curves can be compared.
struct CurveAxes {
  Axis across;  ///< steps from 0 to the last
  Axis up;      ///< whole decades
};

/// Returns axes that hold all `curves`; the vertical axis has at most eight decades.
CurveAxes AxesFor(const std::vector<const PlotCurve*>& curves);

/// Draws one panel of curves over steps as an SVG element. Values below the axis are drawn at its lower end.
std::string CurvePlotSvg(const std::vector<PlotCurve>& curves, CurveAxes axes, const std::string& title);

/// Draws a curve between two axes: at most 80 of its points, including the last one.
std::string CurveLine(const PlotCurve& curve, const Axis& across, const Axis& up);

/// Draws the short line that stands for a method in a legend.
std::string CurveKeySvg(std::size_t style);

/// Returns a legend's paragraph: each method's line and name, then `more`.
std::string CurveLegend(const std::vector<std::string>& methods, const std::string& more);

}  // namespace etude
