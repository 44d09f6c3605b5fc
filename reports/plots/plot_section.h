#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/model/summary.h"
#include "reports/words/judged.h"

namespace etude {

/// Draws the plot beside the scenario's answer: every method's values of the first headline metric, under the condition
/// where the method in question differs most from its baseline. Returns "" if no cell has a value.
std::string LeadPictureHtml(const RunData& run, const ScenarioSummary& scenario);

/// Draws all further plots of a scenario, the plots of the method in question first: values under the other conditions,
/// comparisons as estimation plots, the effect of leaving out one sampling unit, error budgets, survival curves.
/// Returns "" if there are no further plots.
std::string PlotSectionHtml(const RunData& run, const ScenarioSummary& scenario);

// The following functions draw the parts of the plot section; the parts about verdicts are in verdicts.h.

/// Draws every method's values of a metric under one condition on a common axis: a row of dots per method, with median
/// (or mean) and quartiles. Returns "" if no cell has a value.
std::string StripsHtml(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition,
                       const std::string& metric);

/// Draws the cost of each processing stage as a waterfall chart with intervals. The chart starts at the method's error
/// and ends at the error that remains when the truth replaces all stages. The caption says whether the costs depend on
/// the order in which the stages were replaced. `condition` is in words and may be empty.
std::string ErrorBudgetHtml(const ErrorBudget& budget, const std::string& condition);

/// Draws survival curves of the metrics that are censored in this scenario (iterations of unsolved cells, waits that
/// never ended): one curve per method, one plot per condition. Returns "" if no metric is censored. Cells in which the
/// event never happened stay in the denominator, so a method gains nothing by giving up early.
std::string SurvivalHtml(const RunData& run, const ScenarioSummary& scenario);

/// Draws each method's median error over iterations, or over frames if the methods follow a motion. The median is taken
/// over the method's cells. A plot over frames shows the first condition only, because the motions of other conditions
/// may differ. Returns "" if the run kept no such curves.
std::string ErrorCurvesHtml(const RunData& run, const ScenarioSummary& scenario);

/// The values of the two methods of a comparison in one world; each of the two methods has a value in this world.
/// Shares are in per cent.
struct PairedWorld {
  int trial = 0;
  /// The index in PairedDots::units of the sampling unit to which the world belongs. If the world belongs to several
  /// units (the playing clip and the wanted clip), this is the index of the first unit.
  std::size_t unit = 0;
  double baseline = 0, method = 0;
  std::string baseline_cell = {}, method_cell = {};  ///< HTML attributes of the dots; "" if the cells were not recorded

  double Difference() const { return method - baseline; }
};

/// The paired values behind one comparison, of at most kMaxPlottedWorlds worlds.
struct PairedDots {
  std::vector<PairedWorld> worlds;  ///< worlds in the order of their trials
  std::vector<std::string> units;   ///< names of the sampling units, sorted; empty if every world is its own unit
  std::size_t total = 0;            ///< number of all paired worlds, of which `worlds` holds every n-th
};
inline constexpr std::size_t kMaxPlottedWorlds = 400;

/// Returns the paired worlds of a comparison. The result is empty if no world has values of both methods. The result is
/// also empty if the comparison is with two other methods, each of which is the strongest on one half of the worlds.
PairedDots PairedWorldsOf(const RunData& run, const ScenarioSummary& scenario, const Judged& judged);

/// Draws one comparison as an estimation plot (Gardner & Altman 1986; paired as in Ho et al. 2019). The first panel
/// joins each world's values under both methods by a line. The second panel shows the paired differences as dots, their
/// median or mean, and the mean of each sampling unit with the interval over units. Intervals are 95 %, and a band
/// marks differences below the practical threshold. Dots are coloured by sampling unit, or by method if every world is
/// its own unit. Returns "" without worlds.
std::string EstimationHtml(const ScenarioSummary& scenario, const Judged& judged, const PairedDots& pairs);

/// Returns a legend that explains the estimation plots of a metric; all plots of the metric share this legend.
std::string EstimationLegend(const ScenarioSummary& scenario, const std::string& metric);

/// Returns the legend of the sampling units' colours; "" if every world is its own unit.
std::string UnitLegendHtml(const PairedDots& pairs);

/// Returns in words how the difference of a comparison changes if one sampling unit is left out: the range of the
/// differences, the unit with the largest effect, and whether this unit alone makes or hides the difference. Returns ""
/// if every world is its own unit.
std::string WithoutEachUnit(const Comparison& comparison, SamplingUnit unit);

/// Draws, on one axis with the practical threshold, one mean difference for each sampling unit: the mean that results
/// when this unit is left out. The words of WithoutEachUnit follow.
std::string LeftOutStripHtml(const Comparison& comparison, SamplingUnit unit);

}  // namespace etude
