#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Draws a scenario's pictures of worlds by its first headline metric: every method's values, what is censored, and the
/// method in question against its baseline and against the strongest other one as estimation plots, with what leaving
/// one unit out does. Some of the other methods' plots follow, folded away; "" when no cell has a value.
std::string PlotSectionHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
