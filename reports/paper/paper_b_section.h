#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Returns true if a cell of this scenario recorded what this section shows: the error curves or the final errors of
/// end effectors (key `record` of the task ik).
bool ShowsPaperB(const RunData& run, const ScenarioSummary& scenario);

/// Returns the errors of single end effectors and the angles of joints in the form of paper B: the curves of figure
/// 5.2, tables 5.1 and 5.2 filled from the run, and, next to these, the tables that the paper prints. Returns "" if no
/// cell recorded these data.
std::string PaperBHtml(const RunData& run, const ScenarioSummary& scenario);
/// Returns the tables of PaperBHtml as collapsed Markdown tables (<details>), without the curves.
std::string PaperBMarkdown(const RunData& run, const ScenarioSummary& scenario);
/// Returns the tables of PaperBHtml as LaTeX floats for the package booktabs.
std::string PaperBLatex(const RunData& run, const ScenarioSummary& scenario);
/// Returns the numbers in the tables of PaperBHtml as CSV: a header line, then one line per number in full precision.
std::string PaperBCsv(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
