#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Curves of what is censored in this scenario (solver steps of what was not solved, waits without an end), a line per
/// method and a panel per condition; "" where nothing is. What never is done stays in the denominator to the end, so that
/// a method which gives up early gains nothing by it.
std::string SurvivalHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
