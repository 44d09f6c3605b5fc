#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Writes one scenario as LaTeX floats, for plain pdflatex with the package booktabs: per condition every headline
/// metric of every method with its interval, how many cells have it, the paired comparison with the baseline and its
/// verdict; then, where the cells keep them, paper B's tables. Figures are rounded as on the page; the CSV files hold
/// all digits.
std::string ScenarioLatex(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
