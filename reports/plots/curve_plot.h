#pragma once

#include <string>
#include <vector>

#include "io/drawing/panel.h"

namespace etude {

struct PlotCurve {
  std::size_t style = 0;  ///< index of the method, which selects the colour and the dashes
  bool faint = false;
  std::vector<double> values;  ///< values on the vertical axis, never negative
  /// Position of each value on the horizontal axis; if empty, the positions are 0, 1, 2, ….
  std::vector<double> at = {};
};

/// Axes that neighbouring panels share, so that the curves of these panels can be compared.
struct CurveAxes {
  Axis across;  ///< horizontal axis: from 0 to the last index of the longest curve
  Axis up;      ///< vertical axis: logarithmic, from one power of ten to another
};

/// Returns axes that contain all `curves`. The vertical axis covers at most eight powers of ten.
CurveAxes AxesFor(const std::vector<const PlotCurve*>& curves);

/// Draws curves over the positions of their values as an SVG element. A value below the range of the vertical axis is
/// drawn at the axis's lower end.
std::string CurvePlotSvg(const std::vector<PlotCurve>& curves, CurveAxes axes, const std::string& title);

/// Returns a curve as an SVG line: at most 80 points of the curve, including the last point.
std::string CurveLine(const PlotCurve& curve, const Axis& across, const Axis& up);

/// Returns a legend's paragraph: each method's line and name, then `more`.
std::string CurveLegend(const std::vector<std::string>& methods, const std::string& more);

}  // namespace etude
