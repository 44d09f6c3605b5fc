#include "reports/growth/growth_plot.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "reports/paper/curve_plot.h"
#include "reports/words/escape.h"

namespace etude {
namespace {

// The panel in its own units; the page scales it.
constexpr double kWidth = 420, kHeight = 260;
constexpr double kLeft = 44, kRight = 14, kTop = 10, kBottom = 34;

/// Whole decades.
struct Decades {
  int low = 0, high = 1;
};

Decades DecadesOf(const std::vector<GrowthCurve>& curves, double GrowthPoint::*part) {
  double low = INFINITY, high = -INFINITY;
  for (const GrowthCurve& curve : curves) {
    for (const GrowthPoint& point : curve.points) {
      low = std::min(low, std::log10(point.*part));
      high = std::max(high, std::log10(point.*part));
    }
  }
  const int first = static_cast<int>(std::floor(low));
  return {first, std::max(static_cast<int>(std::ceil(high)), first + 1)};
}

double ShareOf(double value, const Decades& decades) {
  return (std::log10(value) - decades.low) / (decades.high - decades.low);
}

struct Axes {
  Decades frames, values;

  double X(double frames_value) const { return kLeft + (kWidth - kLeft - kRight) * ShareOf(frames_value, frames); }
  double Y(double value) const { return kHeight - kBottom - (kHeight - kTop - kBottom) * ShareOf(value, values); }
};

std::string Grid(const Axes& axes) {
  std::string svg;
  for (int decade = axes.values.low; decade <= axes.values.high; ++decade) {
    const double y = axes.Y(std::pow(10.0, decade));
    svg += fmt::format("<path d=\"M{} {:.1f}H{}\"/><text x=\"{}\" y=\"{:.1f}\" class=\"y\">{}</text>", kLeft, y,
                       kWidth - kRight, kLeft - 5, y + 4, DecadeText(decade));
  }
  for (int decade = axes.frames.low; decade <= axes.frames.high; ++decade) {
    const double x = axes.X(std::pow(10.0, decade));
    svg += fmt::format("<path d=\"M{:.1f} {}V{}\"/><text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>", x,
                       kTop, kHeight - kBottom, x, kHeight - kBottom + 13, DecadeText(decade));
  }
  return svg +
         fmt::format("<text x=\"{}\" y=\"{}\" class=\"y\">frames in the library</text>", kWidth - kRight, kHeight - 4);
}

std::string Line(const GrowthCurve& curve, const Axes& axes) {
  std::string points, dots;
  for (const GrowthPoint& point : curve.points) {
    const double x = axes.X(point.frames), y = axes.Y(point.value);
    points += fmt::format("{}{:.1f},{:.1f}", points.empty() ? "" : " ", x, y);
    dots += fmt::format("<circle class=\"c{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\"/>", curve.style % 8, x, y);
  }
  return fmt::format("<polyline {} points=\"{}\"/>{}", CurveStyle(curve.style), points, dots);
}

}  // namespace

std::string GrowthPlotSvg(const std::vector<GrowthCurve>& curves, const std::string& title) {
  if (std::ranges::all_of(curves, [](const GrowthCurve& curve) { return curve.points.empty(); })) return "";
  const Axes axes{DecadesOf(curves, &GrowthPoint::frames), DecadesOf(curves, &GrowthPoint::value)};
  std::string svg = fmt::format("<svg class=\"panel\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">", kWidth,
                                kHeight, EscapeMarkup(title));
  svg += Grid(axes);
  for (const GrowthCurve& curve : curves) {
    if (!curve.points.empty()) svg += Line(curve, axes);
  }
  return svg + "</svg>";
}

}  // namespace etude
