#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/model/summary.h"
#include "reports/words/judged.h"

namespace etude {

/// Draws the one picture that an answer stands beside: every method's values of the first headline metric, under the
/// condition where the method in question differs most from its baseline; "" when no cell has a value.
std::string LeadPictureHtml(const RunData& run, const ScenarioSummary& scenario);

/// Draws all other pictures of worlds: the strips of the other conditions, comparisons as estimation plots with what
/// leaving one unit out does, the method in question first, error budgets, and what is censored; "" when there is none.
std::string PlotSectionHtml(const RunData& run, const ScenarioSummary& scenario);

// The pictures that it is made of, besides those of verdicts (verdicts.h).

/// Draws every method's values of a metric under one condition, a row of dots each with its median (or mean) and
/// quartiles: whole distributions on one axis. "" when no cell has a value.
std::string StripsHtml(const RunData& run, const ScenarioSummary& scenario, const ConditionSummary& condition,
                       const std::string& metric);

/// Draws the cost of each stage as a waterfall with intervals: from the method's error down to what is left when all
/// stages are true. Says whether the shares depend on an order. `condition` is in words and may be empty.
std::string ErrorBudgetHtml(const ErrorBudget& budget, const std::string& condition);

/// Curves of what is censored in this scenario (solver steps of what was not solved, waits without an end), a line per
/// method and a panel per condition; "" where nothing is. What never is done stays in the denominator to the end, so
/// that a method which gives up early gains nothing by it.
std::string SurvivalHtml(const RunData& run, const ScenarioSummary& scenario);

/// A world in which both methods of a comparison have a value, as shown: shares are per cent already.
struct PairedWorld {
  int trial = 0;
  std::size_t unit = 0;  ///< index of PairedDots::units; of several units (clip left × clip entered) the first
  double baseline = 0, method = 0;
  std::string baseline_cell = {}, method_cell = {};  ///< attributes of the dots, where those cells were recorded

  double Difference() const { return method - baseline; }
};

/// The worlds behind one comparison, at most kMaxPlottedWorlds of them.
struct PairedDots {
  std::vector<PairedWorld> worlds;  ///< in the order of trials
  std::vector<std::string> units;   ///< in the order of their names; empty where worlds are units
  std::size_t total = 0;            ///< of which `worlds` are every so manyeth
};
inline constexpr std::size_t kMaxPlottedWorlds = 400;

/// Pairs the worlds of a comparison. Empty when no world has both values, or the other is no single method (a rival
/// that half of the worlds chose).
PairedDots PairedWorldsOf(const RunData& run, const ScenarioSummary& scenario, const Judged& judged);

/// Draws one comparison as an estimation plot (after Gardner & Altman 1986; paired as in Ho et al. 2019): a panel with
/// every world a dot under both methods, joined, and one with the paired differences on an axis of their own: dots, the
/// aggregate with its 95 % interval, the units' means with theirs, and shaded what does not matter. Dots are coloured
/// by unit, or by method where worlds are units. "" without worlds.
std::string EstimationHtml(const ScenarioSummary& scenario, const Judged& judged, const PairedDots& pairs);

/// Says in words what such plots show of this metric, once for all of them.
std::string EstimationLegend(const ScenarioSummary& scenario, const std::string& metric);

/// Names the units' colours; "" where worlds are units.
std::string UnitLegendHtml(const PairedDots& pairs);

/// Tells in words what leaving one unit out does to a comparison: the range, the unit that matters most, and whether it
/// alone carries the difference, or hides one. "" where worlds are units.
std::string WithoutEachUnit(const Comparison& comparison, SamplingUnit unit);

/// Draws the same as a strip: the mean difference without each unit, against what matters; words beneath.
std::string LeftOutStripHtml(const Comparison& comparison, SamplingUnit unit);

}  // namespace etude
