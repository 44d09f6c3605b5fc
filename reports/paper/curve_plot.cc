#include "reports/paper/curve_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "reports/plots/marks.h"
#include "reports/words/escape.h"

namespace etude {
namespace {

constexpr int kMostDecades = 8;
constexpr std::size_t kMostPoints = 80;

// The panel in its own units; the page scales it.
constexpr double kWidth = 240, kHeight = 150;
constexpr double kLeft = 38, kRight = 8, kTop = 8, kBottom = 20;

double Across(double step, const PlotAxes& axes) { return kLeft + (kWidth - kLeft - kRight) * step / axes.last_step; }

double Down(double decade, const PlotAxes& axes) {
  const double share = (axes.high_decade - decade) / (axes.high_decade - axes.low_decade);
  return kTop + (kHeight - kTop - kBottom) * std::clamp(share, 0.0, 1.0);
}

// A zero has no logarithm: it lies on the lower end, like everything below it.
double DecadeOf(double value, const PlotAxes& axes) { return value > 0 ? std::log10(value) : axes.low_decade; }

std::string Line(const PlotCurve& curve, const PlotAxes& axes) {
  // More points than the panel has room for only make the page heavy; where the curve ends is always told.
  const std::size_t stride = std::max<std::size_t>(1, (curve.values.size() + kMostPoints - 1) / kMostPoints);
  std::string points;
  for (std::size_t i = 0; i < curve.values.size(); i += stride) {
    if (i + stride >= curve.values.size()) i = curve.values.size() - 1;
    points += fmt::format("{}{:.1f},{:.1f}", i == 0 ? "" : " ", Across(static_cast<double>(i), axes),
                          Down(DecadeOf(curve.values[i], axes), axes));
  }
  return fmt::format("<polyline {} points=\"{}\"/>", CurveStyle(curve.style, curve.faint), points);
}

}  // namespace

std::string CurveStyle(std::size_t style, bool faint) {
  return fmt::format("class=\"c{}{}\"{}", style % 8, faint ? " faint" : "", MarkDashes(style));
}

std::string DecadeText(int decade) {
  if (decade < -2 || decade > 8) return fmt::format("1e{}", decade);
  if (decade < 3) return fmt::format("{:g}", std::pow(10.0, decade));
  return fmt::format("{:g}{}", std::pow(10.0, decade % 3), decade < 6 ? 'k' : 'M');
}

PlotAxes AxesFor(const std::vector<const PlotCurve*>& curves) {
  PlotAxes axes;
  double low = INFINITY, high = 0;
  for (const PlotCurve* curve : curves) {
    axes.last_step = std::max(axes.last_step, static_cast<double>(curve->values.size()) - 1);
    for (const double value : curve->values) {
      high = std::max(high, value);
      if (value > 0) low = std::min(low, value);
    }
  }
  if (high > 0) {
    axes.high_decade = static_cast<int>(std::ceil(std::log10(high)));
    axes.low_decade = std::min(static_cast<int>(std::floor(std::log10(low))), axes.high_decade - 1);
    axes.low_decade = std::max(axes.low_decade, axes.high_decade - kMostDecades);
  }
  return axes;
}

std::string CurvePlotSvg(const std::vector<PlotCurve>& curves, const PlotAxes& axes, const std::string& title) {
  std::string svg = fmt::format("<svg class=\"panel\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", kWidth,
                                kHeight, EscapeMarkup(title));
  const int step = axes.high_decade - axes.low_decade > 4 ? 2 : 1;
  for (int decade = axes.high_decade; decade >= axes.low_decade; decade -= step) {
    const double y = Down(decade, axes);
    svg += fmt::format("<path d=\"M{} {:.1f}H{}\"/><text x=\"{}\" y=\"{:.1f}\" class=\"y\">{}</text>", kLeft, y,
                       kWidth - kRight, kLeft - 4, y + 4, DecadeText(decade));
  }
  svg += fmt::format("<text x=\"{}\" y=\"{}\">0</text><text x=\"{}\" y=\"{}\" class=\"y\">{}</text>", kLeft,
                     kHeight - 5, kWidth - kRight, kHeight - 5, axes.last_step);
  for (const PlotCurve& curve : curves) {
    if (!curve.values.empty()) svg += Line(curve, axes);
  }
  return svg + "</svg>";
}

std::string CurveKeySvg(std::size_t style) {
  return fmt::format(
      "<svg class=\"panel key\" viewBox=\"0 0 28 10\" aria-hidden=\"true\"><polyline {} points=\"1,5 27,5\"/></svg>",
      CurveStyle(style));
}

}  // namespace etude
