#pragma once

#include <string>
#include <vector>

#include "io/drawing/panel.h"

namespace etude {

/// A line in a panel.
struct PlotCurve {
  std::size_t style = 0;  ///< colour and dashes, as the page's charts give them to the method of this index
  bool faint = false;
  std::vector<double> values;   ///< not below zero
  std::vector<double> at = {};  ///< where each value stands on the lying axis; empty: at 0, 1, 2, …
};

/// The axes that neighbouring panels share, so that their curves can be compared.
struct CurveAxes {
  Axis across;  ///< steps from 0 to the last
  Axis up;      ///< whole decades
};

/// Makes axes that hold all these curves of steps, at most eight decades of them.
CurveAxes AxesFor(const std::vector<const PlotCurve*>& curves);

/// Draws one panel of curves of steps as an SVG element of the page. Values below the axis lie on its lower end.
std::string CurvePlotSvg(const std::vector<PlotCurve>& curves, CurveAxes axes, const std::string& title);

/// Draws a curve between two axes, at most 80 points of it, the last among them.
std::string CurveLine(const PlotCurve& curve, const Axis& across, const Axis& up);

/// Draws the short line that stands for a method in a legend.
std::string CurveKeySvg(std::size_t style);

/// Names the methods behind their lines: the beginning of a legend's paragraph, which `more` ends.
std::string CurveLegend(const std::vector<std::string>& methods, const std::string& more);

}  // namespace etude
