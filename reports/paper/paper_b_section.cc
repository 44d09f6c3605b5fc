#include "reports/paper/paper_b_section.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "io/drawing/escape.h"
#include "reports/paper/paper_b_tables.h"
#include "reports/plots/curve_plot.h"
#include "reports/words/cell_series.h"
#include "reports/words/figures.h"

namespace etude {
namespace {

struct Quantity {
  const char* suffix;  ///< the end of the series' name, after the effector's name
  const char* label;
};
constexpr std::array<Quantity, 4> kQuantities{{{"position_error_cm", "position, cm"},
                                               {"x_axis_error_deg", "X axis, degrees"},
                                               {"y_axis_error_deg", "Y axis, degrees"},
                                               {"z_axis_error_deg", "Z axis, degrees"}}};
// The end effectors in the order of paper B's figure 5.2.
constexpr std::array<const char*, 4> kEffectors{"head", "left_hand", "right_hand", "right_foot"};

struct Panel {
  std::string title;
  bool of_positions = false;
  std::vector<PlotCurve> curves;
};

/// Returns each method's error curve in the first trial and, if there are several trials, also the median curve over
/// all trials.
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

/// Returns common axes for all plots of position errors (if `of_positions` is true) or of orientation errors (if it is
/// false), so that curves can be compared.
CurveAxes SharedAxes(const std::vector<Panel>& panels, bool of_positions) {
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
  const CurveAxes positions = SharedAxes(panels, true), angles = SharedAxes(panels, false);
  const bool has_medians = std::ranges::any_of(
      panels, [](const Panel& panel) { return std::ranges::any_of(panel.curves, &PlotCurve::faint); });
  const std::string trials =
      has_medians
          ? fmt::format(
                "Thin lines: trial {}, until its solver stopped. Thick lines: the median of all trials, where a trial "
                "whose solver has stopped keeps its last value. The plots show at most the first 200 iterations.",
                trial)
          : fmt::format("The lines show trial {}, until its solver stopped, and at most the first 200 iterations.",
                        trial);
  std::string html =
      CurveLegend(scenario.methods, "Error of each end effector at each iteration, on a logarithmic axis. " + trials) +
      "<div class=\"strip\">";
  for (const Panel& panel : panels) {
    html += fmt::format(
        "<figure><figcaption>{}</figcaption>{}</figure>", EscapeMarkup(panel.title),
        CurvePlotSvg(panel.curves, panel.of_positions ? positions : angles, Description(panel, scenario.methods)));
  }
  return html + "</div>";
}

// The number of tables of effector errors, and the number of tables of joint angles, that fit on a page of A4.
constexpr std::size_t kErrorTablesPerFloat = 6;
constexpr std::size_t kAngleTablesPerFloat = 3;

std::string Under(const PaperBCondition& condition) {
  return condition.condition.empty() ? "" : ", " + ConditionLabel(condition.condition);
}

// Table 5.2 contains the errors of table 5.1 and, in addition, the hidden angles, which no target determines.
std::string_view TableName(const PaperBSet& set) { return set.angles.empty() ? "table 5.1" : "table 5.2"; }

std::string Note(const PaperBSet& set) {
  return set.angle_note.empty() ? set.error_note : set.error_note + " " + set.angle_note;
}

std::string TablesHtml(const std::vector<PaperTable>& tables, std::string_view shape) {
  if (tables.empty()) return "";
  std::string html = fmt::format("<div class=\"tables {}\">", shape);
  for (const PaperTable& table : tables) html += TableHtml(TableOf(table));
  return html + "</div>";
}

std::string SetHtml(const PaperBCondition& condition, const PaperBSet& set, bool open) {
  std::string html = fmt::format("<details{}><summary>Paper B’s {}: {}{}</summary>", open ? " open" : "",
                                 TableName(set), EscapeMarkup(set.title), EscapeMarkup(Under(condition)));
  html += fmt::format("<p class=\"quiet legend\">{}", EscapeMarkup(Note(set)));
  if (!set.replay.empty()) {
    html += fmt::format(" This command runs the trial again: <code>{}</code>", EscapeMarkup(set.replay));
  }
  html += "</p>" + TablesHtml(set.errors, "wide") + "<ul class=\"reasons\">";
  for (const std::string& outcome : set.outcomes) html += fmt::format("<li>{}</li>", EscapeMarkup(outcome));
  return html + "</ul>" + TablesHtml(set.angles, "narrow") + "</details>";
}

constexpr std::string_view kPrinted =
    "These results of paper B are for a single simulated pose, which the paper does not specify, so compare only "
    "orders of magnitude. In table 5.2 (d), the elbow and the wrist of the right arm have the same value, as in the "
    "paper.";

std::string PrintedHtml(bool with_angles) {
  std::string html = fmt::format(
      "<details><summary>Tables 5.1 and 5.2 as printed in the paper</summary><p class=\"quiet legend\">{}</p>",
      kPrinted);
  html += TablesHtml(PaperBPrintedErrors(), "wide");
  if (with_angles) html += TablesHtml(PaperBPrintedAngles(), "narrow");
  return html + "</details>";
}

/// Returns LaTeX table environments with at most `most` tables each. The note is in the caption of the first
/// environment.
std::string FloatsLatex(const std::vector<PaperTable>& tables, std::size_t most, const std::string& caption,
                        const std::string& note) {
  std::string text;
  for (std::size_t begin = 0; begin < tables.size(); begin += most) {
    text += fmt::format("\n\\begin{{table}}[!htbp]\n\\centering\\small\n\\caption{{{}{}}}\n", EscapeLatex(caption),
                        begin == 0 ? ". " + EscapeLatex(note) : " (continued)");
    for (std::size_t i = begin; i < std::min(begin + most, tables.size()); ++i) {
      text += "\\par\\medskip\n" + TableLatex(TableOf(tables[i]));
    }
    text += "\\end{table}\n";
  }
  return text;
}

/// Returns true if a cell of this scenario recorded the error curves of end effectors: the task is `ik`, with `record:
/// [effector_curves]`.
bool HasEffectorCurves(const RunData& run, const ScenarioSummary& scenario) {
  return scenario.task == "ik" && KeepsSeries(run, scenario, "head_position_error_cm");
}

/// Draws paper B's figure 5.2: each end effector's position error, and the angular error of each axis of the effector,
/// over iterations. Each small plot shows all methods on a logarithmic axis: a thin line for the first trial, a thick
/// line for the median of all trials. Returns one collapsed figure (<details>) per condition; "" if no cell recorded
/// these curves.
std::string EffectorCurvesHtml(const RunData& run, const ScenarioSummary& scenario) {
  if (!HasEffectorCurves(run, scenario)) return "";
  const CellSeriesIndex series(run);
  std::string html;
  for (const ConditionSummary& condition : scenario.conditions) {
    const std::vector<const Row*> rows = RowsUnder(run, scenario.name, condition.condition);
    const std::vector<Panel> panels = PanelsOf(series, rows, scenario);
    if (std::ranges::all_of(panels, [](const Panel& panel) { return panel.curves.empty(); })) continue;
    const std::string label = ConditionLabel(condition.condition);
    html += fmt::format(
        "<details{}><summary>Paper B’s figure 5.2: how each end effector approaches its target{}</summary>{}</details>",
        html.empty() ? " open" : "", label.empty() ? "" : EscapeMarkup(", " + label),
        Figure(panels, scenario, rows.front()->trial));
  }
  return html;
}

}  // namespace

bool ShowsPaperB(const RunData& run, const ScenarioSummary& scenario) {
  return HasPaperBTables(run, scenario) || HasEffectorCurves(run, scenario);
}

std::string PaperBHtml(const RunData& run, const ScenarioSummary& scenario) {
  std::string html = EffectorCurvesHtml(run, scenario);
  bool open = true, with_angles = false;
  for (const PaperBCondition& condition : PaperBTables(run, scenario)) {
    for (const PaperBSet& set : condition.sets) {
      html += SetHtml(condition, set, open);
      open = false;
      with_angles = with_angles || !set.angles.empty();
    }
  }
  // If no table was filled from the run, leave out the tables that the paper prints, because there is nothing with
  // which a reader could compare them.
  return open ? html : html + PrintedHtml(with_angles);
}

std::string PaperBMarkdown(const RunData& run, const ScenarioSummary& scenario) {
  std::string text;
  for (const PaperBCondition& condition : PaperBTables(run, scenario)) {
    for (const PaperBSet& set : condition.sets) {
      text += fmt::format("\n<details><summary>Paper B's {}: {}{}</summary>\n\n{}\n", TableName(set),
                          EscapeMarkup(set.title), EscapeMarkup(Under(condition)), EscapeMarkdown(Note(set)));
      if (!set.replay.empty())
        text += fmt::format("\nThis command runs the trial again: {}\n", EscapeMarkdown(set.replay));
      for (const PaperTable& table : set.errors) text += TableMarkdown(TableOf(table));
      text += '\n';
      for (const std::string& outcome : set.outcomes) text += fmt::format("- {}\n", EscapeMarkdown(outcome));
      for (const PaperTable& table : set.angles) text += TableMarkdown(TableOf(table));
      text += "\n</details>\n";
    }
  }
  return text;
}

std::string PaperBLatex(const RunData& run, const ScenarioSummary& scenario) {
  std::string text;
  for (const PaperBCondition& condition : PaperBTables(run, scenario)) {
    for (const PaperBSet& set : condition.sets) {
      const std::string caption = fmt::format("{}: {}{}", scenario.name, set.title, Under(condition));
      std::string note = set.error_note;
      for (const std::string& outcome : set.outcomes) note += fmt::format(" {}.", outcome);
      text += FloatsLatex(set.errors, kErrorTablesPerFloat, caption, note);
      text += FloatsLatex(set.angles, kAngleTablesPerFloat, caption + ", hidden angles", set.angle_note);
    }
  }
  return text;
}

std::string PaperBCsv(const RunData& run, const ScenarioSummary& scenario) {
  Table csv;
  for (const char* head : {"scenario", "condition", "trials", "table", "row", "quantity", "axis", "value"}) {
    csv.columns.push_back({head});
  }
  for (const PaperBCondition& condition : PaperBTables(run, scenario)) {
    const std::string label = ConditionLabel(condition.condition);
    for (const PaperBSet& set : condition.sets) {
      for (const auto* tables : {&set.errors, &set.angles}) {
        for (const PaperTable& table : *tables) {
          const Table shown = TableOf(table);
          for (const TableRow& row : shown.rows) {
            for (std::size_t i = 1; i < row.cells.size(); ++i) {
              csv.rows.push_back({{scenario.name, label, set.title, table.caption, row.cells.front().text,
                                   shown.columns[i].over, shown.columns[i].head, row.cells[i].number}});
            }
          }
        }
      }
    }
  }
  return csv.rows.empty() ? "" : TableCsv(csv);
}

}  // namespace etude
