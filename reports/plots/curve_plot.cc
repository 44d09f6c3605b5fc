#include "reports/plots/curve_plot.h"

#include <fmt/core.h>

#include <algorithm>

#include "io/drawing/escape.h"
#include "io/drawing/marks.h"

namespace etude {
namespace {

constexpr std::size_t kMaxPoints = 80;

// Size and margins of a plot, in units that the page scales.
constexpr double kSmallWidth = 240, kSmallHeight = 150;
constexpr double kSmallLeft = 38, kSmallRight = 8, kSmallTop = 8, kSmallBottom = 20;

/// Returns the attributes of a curve's colour and dashes: `class="c2" stroke-dasharray="6 4"`.
std::string CurveStyle(std::size_t style, bool faint = false) {
  return fmt::format("class=\"c{}{}\"{}", style % 8, faint ? " faint" : "", MarkDashes(style));
}

}  // namespace

CurveAxes AxesFor(const std::vector<const PlotCurve*>& curves) {
  CurveAxes axes;
  std::vector<double> all;
  for (const PlotCurve* curve : curves) {
    axes.across.high = std::max(axes.across.high, static_cast<double>(curve->values.size()) - 1);
    all.insert(all.end(), curve->values.begin(), curve->values.end());
  }
  axes.up = DecadeAxis(all);
  return axes;
}

std::string CurveLine(const PlotCurve& curve, const Axis& across, const Axis& up) {
  // Thin the curve out, because more points would make the page larger without showing more. The last point is always
  // drawn.
  const std::size_t count = curve.values.size();
  const std::size_t stride = std::max<std::size_t>(1, (count + kMaxPoints - 1) / kMaxPoints);
  std::string points;
  for (std::size_t i = 0; i < count; i += stride) {
    if (i + stride >= count) i = count - 1;
    const double place = curve.at.empty() ? static_cast<double>(i) : curve.at[i];
    points += fmt::format("{}{:.1f},{:.1f}", i == 0 ? "" : " ", across.At(place), up.At(curve.values[i]));
  }
  return fmt::format("<polyline {} points=\"{}\"/>", CurveStyle(curve.style, curve.faint), points);
}

std::string CurvePlotSvg(const std::vector<PlotCurve>& curves, CurveAxes axes, const std::string& title) {
  axes.across.from = kSmallLeft, axes.across.to = kSmallWidth - kSmallRight;
  axes.up.from = kSmallHeight - kSmallBottom, axes.up.to = kSmallTop;
  std::string svg = BeginPanel(kSmallHeight, title, kSmallWidth, "panel") +
                    VerticalAxisGrid(axes.up, kSmallLeft, kSmallWidth - kSmallRight) +
                    PanelText(kSmallLeft, kSmallHeight - 5, "0", "start") +
                    PanelText(kSmallWidth - kSmallRight, kSmallHeight - 5, fmt::format("{}", axes.across.high), "end");
  for (const PlotCurve& curve : curves) {
    if (!curve.values.empty()) svg += CurveLine(curve, axes.across, axes.up);
  }
  return svg + "</svg>";
}

std::string CurveLegend(const std::vector<std::string>& methods, const std::string& more) {
  std::string html = "<p class=\"quiet legend\">";
  for (std::size_t m = 0; m < methods.size(); ++m) {
    html += fmt::format("<span class=\"method\">{} {}</span> ", LineKeySvg(m), EscapeMarkup(methods[m]));
  }
  return html + "<br>" + more + "</p>";
}

}  // namespace etude
