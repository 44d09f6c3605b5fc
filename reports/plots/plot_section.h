#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/model/summary.h"
#include "reports/words/judged.h"

namespace etude {

/// Draws the picture beside the answer: every method's values of the first headline metric, under the condition where
/// the method in question differs most from its baseline. Returns "" if no cell has a value.
std::string LeadPictureHtml(const RunData& run, const ScenarioSummary& scenario);

/// Draws all further pictures of a scenario's worlds, the method in question first: strips of the other conditions,
/// comparisons as estimation plots, the effect of leaving a unit out, error budgets, survival curves. Returns "" if
/// there are none.
std::string PlotSectionHtml(const RunData& run, const ScenarioSummary& scenario);

// The parts of the plot section, except the parts on verdicts (verdicts.h).

/// Draws every method's values of a metric under one condition on one axis: a row of dots each, with median (or mean)
/// and quartiles. Returns "" if no cell has a value.
std::string StripsHtml(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition,
                       const std::string& metric);

/// Draws the cost of each stage as a waterfall with intervals, from the method's error to the error that remains when
/// the truth replaces all stages. The caption says whether the shares depend on an order of the stages. `condition` is
/// in words and may be empty.
std::string ErrorBudgetHtml(const ErrorBudget& budget, const std::string& condition);

/// Draws survival curves of the metrics that are censored in this scenario (steps of unsolved cells, waits without an
/// end): one curve per method, one panel per condition. Returns "" if no metric is censored. Cells that never end stay
/// in the denominator, so a method gains nothing by giving up early.
std::string SurvivalHtml(const RunData& run, const ScenarioSummary& scenario);

/// A world in which both methods of a comparison have a value. Shares are in per cent.
struct PairedWorld {
  int trial = 0;
  /// The world's index in PairedDots::units. If the world has several units (clip left × clip entered), the index of
  /// the first.
  std::size_t unit = 0;
  double baseline = 0, method = 0;
  std::string baseline_cell = {}, method_cell = {};  ///< HTML attributes of the dots; "" if the cells were not recorded

  double Difference() const { return method - baseline; }
};

/// The worlds behind one comparison, at most kMaxPlottedWorlds.
struct PairedDots {
  std::vector<PairedWorld> worlds;  ///< in order of their trials
  std::vector<std::string> units;   ///< sorted by name; empty if worlds are units
  std::size_t total = 0;            ///< number of all paired worlds; `worlds` holds every n-th of them
};
inline constexpr std::size_t kMaxPlottedWorlds = 400;

/// Returns the paired worlds of a comparison. The result is empty if no world has both values, or if the other side
/// consists of two rivals, each chosen on half of the worlds.
PairedDots PairedWorldsOf(const RunData& run, const ScenarioSummary& scenario, const Judged& judged);

/// Draws one comparison as an estimation plot (Gardner & Altman 1986; paired as in Ho et al. 2019). The first panel
/// joins each world's dots under both methods. The second shows the paired differences: dots, the aggregate and the
/// units' means, each with a 95 % interval, and a band for differences that do not matter. Dots are coloured by unit,
/// or by method if worlds are units. Returns "" without worlds.
std::string EstimationHtml(const ScenarioSummary& scenario, const Judged& judged, const PairedDots& pairs);

/// Returns a legend that explains the estimation plots of a metric; one legend serves all of them.
std::string EstimationLegend(const ScenarioSummary& scenario, const std::string& metric);

/// Returns the legend of the units' colours; "" if worlds are units.
std::string UnitLegendHtml(const PairedDots& pairs);

/// Returns in words how a comparison changes if one unit is left out: the range, the unit that matters most, and
/// whether that unit alone makes or hides the difference. Returns "" if worlds are units.
std::string WithoutEachUnit(const Comparison& comparison, SamplingUnit unit);

/// Draws a strip of the mean differences without each unit, with the practical threshold, above the words of
/// WithoutEachUnit.
std::string LeftOutStripHtml(const Comparison& comparison, SamplingUnit unit);

}  // namespace etude
