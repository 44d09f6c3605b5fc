#include "reports/plots/growth.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>

#include "engine/base/order_statistics.h"
#include "io/drawing/escape.h"
#include "io/drawing/table.h"
#include "reports/plots/curve_plot.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

constexpr const char* kFrames = "frames";

/// A condition, split into the library's size and everything else.
struct SizedCondition {
  double frames = 0;
  std::vector<SweptValue> rest;
};

std::optional<SizedCondition> SplitCondition(const std::vector<SweptValue>& condition) {
  SizedCondition taken;
  for (const SweptValue& swept : condition) {
    if (swept.key != kFrames) {
      taken.rest.push_back(swept);
      continue;
    }
    const char* const end = swept.value.data() + swept.value.size();
    if (std::from_chars(swept.value.data(), end, taken.frames).ptr != end) return std::nullopt;
  }
  return taken.frames > 0 ? std::optional(taken) : std::nullopt;
}

/// Returns the processor time of a query in microseconds; nothing if the cell took less than one tick of the clock.
std::optional<double> MicrosecondsOf(const RunData& run, const Row& row, const CellSeriesIndex& series) {
  const auto seconds = run.cpu_seconds.find(row.Id());
  const std::vector<double>* queries = series.Find(row, "matches_per_query");
  if (seconds == run.cpu_seconds.end() || seconds->second <= 0 || queries == nullptr || queries->empty()) return {};
  constexpr double kMicro = 1e6;
  return kMicro * seconds->second / static_cast<double>(queries->size());
}

void AddMedian(double frames, std::vector<double> values, GrowthCurve& curve) {
  std::erase_if(values, [](double value) { return value <= 0; });  // zero has no logarithm
  if (!values.empty()) curve.points.push_back({frames, Median(std::move(values))});
}

void SortByFrames(std::vector<GrowthCurve>& curves) {
  for (GrowthCurve& curve : curves) std::ranges::sort(curve.points, {}, &GrowthPoint::frames);
}

// Size and margins of the panel in its own units; the page scales it.
constexpr double kGrowthWidth = 420, kGrowthHeight = 260;
constexpr double kGrowthLeft = 44, kGrowthRight = 14, kGrowthTop = 10, kGrowthBottom = 34;

Axis DecadesOf(const std::vector<GrowthCurve>& curves, double GrowthPoint::*part) {
  std::vector<double> values;
  for (const GrowthCurve& curve : curves) {
    for (const GrowthPoint& point : curve.points) values.push_back(point.*part);
  }
  return DecadeAxis(values);
}

std::string Line(const GrowthCurve& curve, const Axis& frames, const Axis& values) {
  PlotCurve line{.style = curve.style, .values = {}};
  std::string dots;
  for (const GrowthPoint& point : curve.points) {
    line.at.push_back(point.frames);
    line.values.push_back(point.value);
    dots += fmt::format("<circle class=\"c{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\"/>", curve.style % 8,
                        frames.At(point.frames), values.At(point.value));
  }
  return CurveLine(line, frames, values) + dots;
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

std::string FiguresHtml(const Growth& growth, const std::vector<std::string>& methods) {
  std::set<double> sizes;
  for (const auto* curves : {&growth.distances, &growth.microseconds}) {
    for (const GrowthCurve& curve : *curves) {
      for (const GrowthPoint& point : curve.points) sizes.insert(point.frames);
    }
  }
  const std::string caption = "Distances computed per query, and processor time (µs)";
  Table table{
      .label = caption, .style = "printed", .caption = caption, .columns = {{.head = "frames", .is_row_head = true}}};
  for (const double size : sizes) table.columns.push_back({.head = FormatNumber(size), .is_number = true});
  for (std::size_t m = 0; m < methods.size(); ++m) {
    table.rows.push_back({{methods[m]}});
    for (const double size : sizes) {
      table.rows.back().cells.emplace_back(
          fmt::format("{} · {} µs", CellText(growth.distances[m], size), CellText(growth.microseconds[m], size)));
    }
  }
  return TableHtml(table);
}

}  // namespace

std::vector<Growth> ComputeGrowth(const RunData& run, const ScenarioSummary& scenario) {
  if (scenario.task != "search") return {};
  const CellSeriesIndex series(run);
  std::vector<Growth> all;
  // Conditions that differ only in the library's size share a Growth.
  for (const ConditionSummary& condition : scenario.conditions) {
    const auto sized = SplitCondition(condition.condition);
    if (!sized) continue;
    const std::string label = ConditionLabel(sized->rest);
    auto growth = std::ranges::find(all, label, &Growth::label);
    if (growth == all.end()) growth = all.insert(growth, {label, {}, {}});
    growth->distances.resize(scenario.methods.size());
    growth->microseconds.resize(scenario.methods.size());
    // The median over the trials is one point of a method's curve.
    const std::vector<const Row*> rows = RowsUnder(run, scenario.name, condition.condition);
    for (std::size_t m = 0; m < scenario.methods.size(); ++m) {
      std::vector<double> distances, microseconds;
      for (const Row* row : rows) {
        if (row->method != scenario.methods[m]) continue;
        if (const auto value = ValueOf(*row, "distances_per_query")) distances.push_back(*value);
        if (const auto value = MicrosecondsOf(run, *row, series)) microseconds.push_back(*value);
      }
      growth->distances[m].style = growth->microseconds[m].style = m;
      AddMedian(sized->frames, std::move(distances), growth->distances[m]);
      AddMedian(sized->frames, std::move(microseconds), growth->microseconds[m]);
    }
  }
  for (Growth& growth : all) {
    SortByFrames(growth.distances);
    SortByFrames(growth.microseconds);
  }
  return all;
}

std::string GrowthPlotSvg(const std::vector<GrowthCurve>& curves, const std::string& title) {
  if (std::ranges::all_of(curves, [](const GrowthCurve& curve) { return curve.points.empty(); })) return "";
  Axis frames = DecadesOf(curves, &GrowthPoint::frames), values = DecadesOf(curves, &GrowthPoint::value);
  frames.from = kGrowthLeft, frames.to = kGrowthWidth - kGrowthRight;
  values.from = kGrowthHeight - kGrowthBottom, values.to = kGrowthTop;
  std::string svg = BeginPanel(kGrowthHeight, title, kGrowthWidth, "panel") +
                    VerticalAxisGrid(values, kGrowthLeft, kGrowthWidth - kGrowthRight) +
                    HorizontalAxisGrid(frames, kGrowthTop, kGrowthHeight - kGrowthBottom) +
                    PanelText(kGrowthWidth - kGrowthRight, kGrowthHeight - 4, "frames in the library", "end");
  for (const GrowthCurve& curve : curves) {
    if (!curve.points.empty()) svg += Line(curve, frames, values);
  }
  return svg + "</svg>";
}

bool ShowsGrowth(const ScenarioSummary& scenario) {
  return scenario.task == "search" && std::ranges::any_of(scenario.conditions, [](const ConditionSummary& condition) {
           return std::ranges::find(condition.condition, "frames", &SweptValue::key) != condition.condition.end();
         });
}

std::string GrowthHtml(const RunData& run, const ScenarioSummary& scenario) {
  std::string html;
  for (const Growth& growth : ComputeGrowth(run, scenario)) {
    const std::string label = growth.label.empty() ? "" : EscapeMarkup(", " + growth.label);
    html += fmt::format("<details><summary>How a search grows with the library{}</summary>{}", label,
                        CurveLegend(scenario.methods, "Medians over the trials; both axes are logarithmic."));
    html += "<div class=\"growth\">";
    html += Figure("Distances computed per query", growth.distances, scenario.methods);
    html += Figure("Processor time per query, µs (this machine’s)", growth.microseconds, scenario.methods);
    html += fmt::format("</div>{}</details>", FiguresHtml(growth, scenario.methods));
  }
  return html;
}

}  // namespace etude
