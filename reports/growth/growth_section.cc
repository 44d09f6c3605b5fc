#include "reports/growth/growth_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <set>

#include "reports/growth/growth_curves.h"
#include "reports/growth/growth_plot.h"
#include "reports/paper/curve_plot.h"
#include "reports/words/escape.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

std::string Legend(const std::vector<std::string>& methods) {
  std::string html = "<p class=\"quiet legend\">";
  for (std::size_t m = 0; m < methods.size(); ++m) {
    html += fmt::format("<span class=\"method\">{} {}</span> ", CurveKeySvg(m), EscapeMarkup(methods[m]));
  }
  return html + "<br>Medians over the trials; both axes are logarithmic.</p>";
}

std::string Describe(const std::string& what, const std::vector<GrowthCurve>& curves,
                     const std::vector<std::string>& methods) {
  std::string text = what + ".";
  for (const GrowthCurve& curve : curves) {
    if (curve.points.empty()) continue;
    const GrowthPoint &first = curve.points.front(), &last = curve.points.back();
    text += fmt::format(" {}: {} at {} frames, {} at {}.", methods[curve.style], FormatNumber(first.value),
                        FormatNumber(first.frames), FormatNumber(last.value), FormatNumber(last.frames));
  }
  return text;
}

std::string Figure(const std::string& caption, const std::vector<GrowthCurve>& curves,
                   const std::vector<std::string>& methods) {
  const std::string svg = GrowthPlotSvg(curves, Describe(caption, curves, methods));
  if (svg.empty()) return "";
  return fmt::format("<figure><figcaption>{}</figcaption>{}</figure>", EscapeMarkup(caption), svg);
}

std::string CellText(const GrowthCurve& curve, double frames) {
  const auto point = std::ranges::find(curve.points, frames, &GrowthPoint::frames);
  return point == curve.points.end() ? std::string(kNoValue) : FormatNumber(point->value);
}

std::string Table(const Growth& growth, const std::vector<std::string>& methods) {
  std::set<double> sizes;
  for (const auto* curves : {&growth.distances, &growth.microseconds}) {
    for (const GrowthCurve& curve : *curves) {
      for (const GrowthPoint& point : curve.points) sizes.insert(point.frames);
    }
  }
  std::string html =
      "<div class=\"scroll\"><table class=\"printed\"><caption>Distances computed per query, and processor time "
      "(µs)</caption><thead><tr><th scope=\"col\">frames</th>";
  for (const double size : sizes) html += fmt::format("<th scope=\"col\" class=\"n\">{}</th>", FormatNumber(size));
  html += "</tr></thead><tbody>";
  for (std::size_t m = 0; m < methods.size(); ++m) {
    html += fmt::format("<tr><th scope=\"row\">{}</th>", EscapeMarkup(methods[m]));
    for (const double size : sizes) {
      html += fmt::format("<td class=\"n\">{} · {} µs</td>", CellText(growth.distances[m], size),
                          CellText(growth.microseconds[m], size));
    }
    html += "</tr>";
  }
  return html + "</tbody></table></div>";
}

}  // namespace

bool ShowsGrowth(const ScenarioSummary& scenario) {
  return scenario.task == "search" && std::ranges::any_of(scenario.conditions, [](const ConditionSummary& condition) {
           return std::ranges::find(condition.condition, "frames", &SweptValue::key) != condition.condition.end();
         });
}

std::string GrowthHtml(const RunData& run, const ScenarioSummary& scenario) {
  std::string html;
  for (const Growth& growth : ComputeGrowth(run, scenario)) {
    const std::string label = growth.label.empty() ? "" : EscapeMarkup(", " + growth.label);
    html += fmt::format("<details open><summary>How a search grows with the library{}</summary>{}", label,
                        Legend(scenario.methods));
    html += "<div class=\"growth\">";
    html += Figure("Distances computed per query", growth.distances, scenario.methods);
    html += Figure("Processor time per query, µs (this machine’s)", growth.microseconds, scenario.methods);
    html += fmt::format("</div>{}</details>", Table(growth, scenario.methods));
  }
  return html;
}

}  // namespace etude
