#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "io/drawing/escape.h"
#include "io/drawing/marks.h"
#include "io/drawing/panel.h"
#include "reports/plots/curve_plot.h"
#include "reports/plots/plot_section.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"
#include "reports/words/judged.h"

namespace etude {
namespace {

constexpr double kErrorsHeight = 200, kErrorsTop = 8, kErrorsBottom = 172;
// The maximum number of steps whose values can be read. More steps would make the page larger.
constexpr std::size_t kMaxColumns = 120;
// Values below this share of the largest value are drawn at the lower end of a logarithmic axis.
constexpr double kMinShareShown = 1e-8;

std::string Caption(const std::string& what, const MetricWords& words) {
  const std::string unit = UnitOf(words);
  std::string caption = what + " of the " + words.plain_label;
  if (!unit.empty()) caption += fmt::format(" ({})", unit);
  if (const auto direction = DirectionWords(words.direction); !direction.empty())
    caption += fmt::format("; {}", direction);
  return caption;
}

// Returns the name of a metric's variant for the worst effector: "orientation_error_max_deg" for
// "orientation_error_deg".
std::string WorstOf(const std::string& metric) {
  const std::size_t unit = metric.rfind('_');
  return unit == std::string::npos ? metric : metric.substr(0, unit) + "_max" + metric.substr(unit);
}

// Returns the first headline metric (or its variant for the worst effector) for which cells keep a series along this
// axis, else the first metric with such a series. Three kinds of series are skipped: series that are not metrics, which
// have plots of their own; series of zeros, which are errors of effectors without a target; and yes-or-no series, whose
// median is meaningless.
std::optional<std::string> FindCurve(const RunData& run, const ScenarioSummary& scenario, const std::string& axis,
                                     const std::map<std::string, std::string>& method_of) {
  std::vector<std::string> found;
  for (const CellSeries& cell : run.series) {
    if (!method_of.contains(cell.cell)) continue;
    for (const Series& series : cell.series) {
      if (series.axis != axis || FindMetric(series.name) == nullptr || WordsFor(series.name).is_share) continue;
      if (std::ranges::any_of(series.values, [](double value) { return value > 0; })) found.push_back(series.name);
    }
  }
  const auto is_found = [&](const std::string& metric) { return std::ranges::find(found, metric) != found.end(); };
  for (const std::string& headline : scenario.headline_metrics) {
    for (const std::string& name : {headline, WorstOf(headline)}) {
      if (is_found(name)) return name;
    }
  }
  return found.empty() ? std::nullopt : std::optional(found.front());
}

/// Returns the median curve of each method over its cells, in the order of the methods' names.
std::vector<PlotCurve> MediansOf(const RunData& run, const ScenarioSummary& scenario, const std::string& name,
                                 const std::map<std::string, std::string>& method_of) {
  std::map<std::string, std::vector<const std::vector<double>*>> curves;
  for (const CellSeries& cell : run.series) {
    const auto method = method_of.find(cell.cell);
    if (method == method_of.end()) continue;
    for (const Series& series : cell.series) {
      if (series.name == name && !series.values.empty()) curves[method->second].push_back(&series.values);
    }
  }
  std::vector<PlotCurve> medians;
  for (const auto& [method, of_method] : curves) {
    medians.push_back({.style = IndexOf(scenario, method), .values = MedianCurve(of_method)});
  }
  return medians;
}

CurveAxes AxesOf(const std::vector<PlotCurve>& curves) {
  CurveAxes axes;
  std::vector<double> all;
  for (const PlotCurve& curve : curves) {
    axes.across.high = std::max(axes.across.high, static_cast<double>(curve.values.size()) - 1);
    all.insert(all.end(), curve.values.begin(), curve.values.end());
  }
  const auto [low, high] = std::ranges::minmax(all);
  axes.up = AxisOf(all, kMinShareShown * high);
  if (!axes.up.is_logarithmic && low >= 0) axes.up.low = 0;
  axes.across.from = kPanelLeft, axes.across.to = kPanelRight;
  axes.up.from = kErrorsBottom, axes.up.to = kErrorsTop;
  return axes;
}

/// Returns invisible columns over the curves. Under the pointer, a column shows every method's value at its step.
std::string Readings(const std::vector<PlotCurve>& curves, const Axis& across, const ScenarioSummary& scenario,
                     const std::string& axis, const std::string& suffix) {
  const std::size_t stride = StrideFor(static_cast<std::size_t>(across.high) + 1, kMaxColumns);
  const double wide = (across.to - across.from) * static_cast<double>(stride) / across.high;
  std::string svg;
  for (std::size_t step = 0; static_cast<double>(step) <= across.high; step += stride) {
    std::string words = fmt::format("{} {}", axis, step);
    for (const PlotCurve& curve : curves) {
      if (step >= curve.values.size()) continue;
      words += fmt::format("\n{}: {}{}", scenario.methods[curve.style], FormatNumber(curve.values[step]), suffix);
    }
    svg += fmt::format(
        "<rect class=\"reading\" x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"{}\"><title>{}</title></rect>",
        across.At(static_cast<double>(step)) - wide / 2, kErrorsTop, wide, kErrorsBottom - kErrorsTop,
        EscapeMarkup(words));
  }
  return svg;
}

}  // namespace

std::string ErrorCurvesHtml(const RunData& run, const ScenarioSummary& scenario) {
  if (scenario.conditions.empty()) return "";
  const bool follows_motion = scenario.task == "tracking";
  const std::vector<SweptValue>& first = scenario.conditions.front().condition;
  // Find the metric, and the cells and methods whose curves are drawn.
  std::map<std::string, std::string> method_of;
  for (const Row& row : run.rows) {
    if (row.scenario == scenario.name && (!follows_motion || row.condition == first)) method_of[row.Id()] = row.method;
  }
  const std::string axis = follows_motion ? "frame" : "iteration";
  const auto name = FindCurve(run, scenario, axis, method_of);
  if (!name) return "";

  // Write the caption, and a description in words for screen readers.
  const MetricWords words = WordsFor(*name);
  std::string caption = Caption(follows_motion ? "Frame by frame: median" : "Error by iteration: median", words);
  if (scenario.conditions.size() > 1) {
    caption += follows_motion ? fmt::format("; under {}", ConditionLabel(first)) : "; over all conditions";
  }
  const std::vector<PlotCurve> curves = MediansOf(run, scenario, *name, method_of);
  const CurveAxes axes = AxesOf(curves);
  std::string described, lines;
  for (const PlotCurve& curve : curves) {
    described +=
        fmt::format("{}: from {} to {} in {}. ", scenario.methods[curve.style],
                    FormatNumber(curve.values.front()) + words.suffix, FormatNumber(curve.values.back()) + words.suffix,
                    Plural(static_cast<long long>(curve.values.size()) - 1, axis));
    lines += CurveLine(curve, axes.across, axes.up);
  }
  std::vector<std::string> labels;
  for (const std::string& method : scenario.methods) labels.push_back(MethodLabel(scenario, method));
  return fmt::format("<div class=\"panels\"><figure><figcaption>{}</figcaption>{}{}{}{}{}</svg></figure></div>{}",
                     EscapeMarkup(caption), BeginPanel(kErrorsHeight, described), VerticalAxisGrid(axes.up),
                     HorizontalAxisGrid(axes.across, kErrorsTop, kErrorsBottom), lines,
                     Readings(curves, axes.across, scenario, axis, words.suffix),
                     CurveLegend(labels, "Move the pointer over the plot to read the values."));
}

}  // namespace etude
