#pragma once

#include <string>
#include <vector>

namespace etude {

/// A line in a panel.
struct PlotCurve {
  std::size_t style = 0;  ///< colour and dashes, as the page's charts give them to the method of this index
  bool faint = false;
  std::vector<double> values;  ///< one per iteration, not below zero
};

/// The axes that neighbouring panels share, so that their curves can be compared.
struct PlotAxes {
  int low_decade = 0;    ///< of the logarithmic y axis: 10^low …
  int high_decade = 1;   ///< … to 10^high; always above low
  double last_step = 1;  ///< of the x axis, from 0; always above 0
};

/// Axes that hold all these curves, at most eight decades of them.
PlotAxes AxesFor(const std::vector<const PlotCurve*>& curves);

/// One panel as an SVG element of the page. What lies below the axis is drawn on its lower end.
std::string CurvePlotSvg(const std::vector<PlotCurve>& curves, const PlotAxes& axes, const std::string& title);

/// The attributes that give a line its colour and dashes: `class="c2" stroke-dasharray="6 4"`.
std::string CurveStyle(std::size_t style, bool faint = false);

/// How an axis names a power of ten: "0.01", "100k", "1M", "1e-3".
std::string DecadeText(int decade);

/// The short line that stands for a method in a legend.
std::string CurveKeySvg(std::size_t style);

}  // namespace etude
