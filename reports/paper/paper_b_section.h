#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Is true when any cell of this scenario keeps the curves or errors that these pictures and tables are made of
/// (`record` of the task ik).
bool ShowsPaperB(const RunData& run, const ScenarioSummary& scenario);

/// Shows single effectors and joints as paper B does: the curves of its figure 5.2, its tables 5.1 and 5.2 filled from
/// the run, and beside them what the paper prints. "" for a scenario whose cells keep none.
std::string PaperBHtml(const RunData& run, const ScenarioSummary& scenario);
/// Writes the tables alone, folded away.
std::string PaperBMarkdown(const RunData& run, const ScenarioSummary& scenario);
/// Writes the tables as floats of the package booktabs.
std::string PaperBLatex(const RunData& run, const ScenarioSummary& scenario);
/// Writes a line per figure, full precision, with a header line.
std::string PaperBCsv(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
