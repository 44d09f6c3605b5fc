#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Draws the one picture that an answer stands beside: every method's values of the first headline metric, under the
/// condition where the method in question differs most from its baseline; "" when no cell has a value.
std::string LeadPictureHtml(const RunData& run, const ScenarioSummary& scenario);

/// Draws all other pictures of worlds: the strips of the other conditions, comparisons as estimation plots with what
/// leaving one unit out does, the method in question first, error budgets, and what is censored; "" when there is none.
std::string PlotSectionHtml(const RunData& run, const ScenarioSummary& scenario);

// The pictures that it is made of, besides those with a header of their own.

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

}  // namespace etude
