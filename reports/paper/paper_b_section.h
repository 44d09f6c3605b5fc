#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Returns true if a cell of this scenario keeps the curves or errors that this section shows (key `record` of the task
/// ik).
bool ShowsPaperB(const RunData& run, const ScenarioSummary& scenario);

/// Returns the errors of single effectors and the angles of joints as paper B shows them: the curves of its figure 5.2,
/// its tables 5.1 and 5.2 filled from the run, and beside them the tables that the paper prints. Returns "" if no cell
/// keeps these data.
std::string PaperBHtml(const RunData& run, const ScenarioSummary& scenario);
/// Returns the tables as folded Markdown, without the curves.
std::string PaperBMarkdown(const RunData& run, const ScenarioSummary& scenario);
/// Returns the tables as floats for the package booktabs.
std::string PaperBLatex(const RunData& run, const ScenarioSummary& scenario);
/// Returns the figures of the tables as CSV: one line per figure in full precision, below a header line.
std::string PaperBCsv(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
