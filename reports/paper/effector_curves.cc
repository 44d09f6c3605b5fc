#include "reports/paper/effector_curves.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "reports/paper/curve_plot.h"
#include "reports/paper/paper_b_figures.h"
#include "reports/words/cell_series.h"
#include "reports/words/escape.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

struct Quantity {
  const char* suffix;  ///< of the series' name
  const char* label;
};
constexpr std::array<Quantity, 4> kQuantities{{{"position_error_cm", "position, cm"},
                                               {"x_axis_error_deg", "X axis, degrees"},
                                               {"y_axis_error_deg", "Y axis, degrees"},
                                               {"z_axis_error_deg", "Z axis, degrees"}}};
// Figure 5.2 goes from the head to the foot.
constexpr std::array<const char*, 4> kEffectors{"head", "left_hand", "right_hand", "right_foot"};

/// One panel's curves.
struct Panel {
  std::string title;
  bool of_positions = false;
  std::vector<PlotCurve> curves;
};

/// The first trial's curve of each method, and the median of all trials when there are several.
std::vector<PlotCurve> CurvesOf(const CellSeriesIndex& series, const std::vector<const Row*>& rows,
                                const std::vector<std::string>& methods, const std::string& name) {
  std::vector<PlotCurve> singles, medians;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    std::vector<const std::vector<double>*> curves;
    const std::vector<double>* first = nullptr;
    for (const Row* row : rows) {
      if (row->method != methods[m]) continue;
      const std::vector<double>* values = series.Find(*row, name);
      if (values == nullptr || values->empty()) continue;
      curves.push_back(values);
      if (row->trial == rows.front()->trial) first = values;
    }
    if (first != nullptr) singles.push_back({m, curves.size() > 1, *first});
    if (curves.size() > 1) medians.push_back({m, false, MedianCurve(curves)});
  }
  singles.insert(singles.end(), medians.begin(), medians.end());
  return singles;
}

std::vector<Panel> PanelsOf(const CellSeriesIndex& series, const std::vector<const Row*>& rows,
                            const ScenarioSummary& scenario) {
  std::vector<Panel> panels;
  for (const char* effector : kEffectors) {
    for (const Quantity& quantity : kQuantities) {
      const auto entry = std::ranges::find(kPaperBEffectors, std::string_view(effector), &PaperBEffector::name);
      panels.push_back({fmt::format("{}: {}", entry->description, quantity.label), &quantity == &kQuantities.front(),
                        CurvesOf(series, rows, scenario.methods, fmt::format("{}_{}", effector, quantity.suffix))});
    }
  }
  return panels;
}

/// Positions share their axes, and so do angles.
PlotAxes SharedAxes(const std::vector<Panel>& panels, bool of_positions) {
  std::vector<const PlotCurve*> curves;
  for (const Panel& panel : panels) {
    if (panel.of_positions != of_positions) continue;
    for (const PlotCurve& curve : panel.curves) curves.push_back(&curve);
  }
  return AxesFor(curves);
}

std::string Description(const Panel& panel, const std::vector<std::string>& methods) {
  std::string text = panel.title + ".";
  for (const PlotCurve& curve : panel.curves) {
    if (curve.faint || curve.values.empty()) continue;
    text += fmt::format(" {}: from {} to {}.", methods[curve.style], FormatNumber(curve.values.front()),
                        FormatNumber(curve.values.back()));
  }
  return text;
}

std::string Figure(const std::vector<Panel>& panels, const ScenarioSummary& scenario, int trial) {
  const PlotAxes positions = SharedAxes(panels, true), angles = SharedAxes(panels, false);
  std::string html = "<p class=\"quiet legend\">";
  for (std::size_t m = 0; m < scenario.methods.size(); ++m) {
    html += fmt::format("<span class=\"method\">{} {}</span> ", CurveKeySvg(m), EscapeMarkup(scenario.methods[m]));
  }
  const bool has_medians = std::ranges::any_of(
      panels, [](const Panel& panel) { return std::ranges::any_of(panel.curves, &PlotCurve::faint); });
  html += "<br>Errors of each end effector along the iterations, logarithmic. ";
  html += has_medians ? fmt::format(
                            "Thin: trial {}, until its solver stopped. Thick: the median of all trials; where a solver "
                            "stopped, its trial keeps its last value. At most the first 200 iterations.",
                            trial)
                      : fmt::format("Trial {}, until its solver stopped, at most the first 200 iterations.", trial);
  html += "</p><div class=\"strip\">";
  for (const Panel& panel : panels) {
    html += fmt::format(
        "<figure><figcaption>{}</figcaption>{}</figure>", EscapeMarkup(panel.title),
        CurvePlotSvg(panel.curves, panel.of_positions ? positions : angles, Description(panel, scenario.methods)));
  }
  return html + "</div>";
}

}  // namespace

bool HasEffectorCurves(const RunData& run, const ScenarioSummary& scenario) {
  return scenario.task == "ik" && KeepsSeries(run, scenario, "head_position_error_cm");
}

std::string EffectorCurvesHtml(const RunData& run, const ScenarioSummary& scenario) {
  if (!HasEffectorCurves(run, scenario)) return "";
  const CellSeriesIndex series(run);
  std::string html;
  for (const ConditionSummary& condition : scenario.conditions) {
    const std::vector<const Row*> rows = RowsUnder(run, scenario, condition.condition);
    const std::vector<Panel> panels = PanelsOf(series, rows, scenario);
    if (std::ranges::all_of(panels, [](const Panel& panel) { return panel.curves.empty(); })) continue;
    const std::string label = ConditionLabel(condition.condition);
    html += fmt::format(
        "<details{}><summary>Paper B’s figure 5.2: how each end effector gets there{}</summary>{}</details>",
        html.empty() ? " open" : "", label.empty() ? "" : EscapeMarkup(", " + label),
        Figure(panels, scenario, rows.front()->trial));
  }
  return html;
}

}  // namespace etude
