#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Returns true if a cell of this scenario keeps curves or errors that these pictures and tables show (key `record` of
/// the task ik).
bool ShowsPaperB(const RunData& run, const ScenarioSummary& scenario);

/// Returns single effectors and joints as paper B shows them: the curves of its figure 5.2, its tables 5.1 and 5.2
/// filled from the run, and beside them the tables that the paper prints. Returns "" if no cell keeps them.
std::string PaperBHtml(const RunData& run, const ScenarioSummary& scenario);
/// Returns the tables alone, folded.
std::string PaperBMarkdown(const RunData& run, const ScenarioSummary& scenario);
/// Returns the tables as floats for the package booktabs.
std::string PaperBLatex(const RunData& run, const ScenarioSummary& scenario);
/// Returns one line per figure in full precision, below a header line.
std::string PaperBCsv(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
