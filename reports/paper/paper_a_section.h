#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Whether this scenario is paper A's own (task transition, named `paper-bridging`), or sweeps the key `fuzzy`.
bool ShowsPaperA(const ScenarioSummary& scenario);

/// Figures 5 to 10 of paper A, drawn from the functions that grade poses, with what defuzzification makes of their
/// grades; beside them the program's other fuzzy systems, where the scenario sweeps them. "" where ShowsPaperA is
/// false.
std::string PaperAHtml(const ScenarioSummary& scenario);
/// The functions as a table, folded away.
std::string PaperAMarkdown(const ScenarioSummary& scenario);
/// The same as a float of the package booktabs.
std::string PaperALatex(const ScenarioSummary& scenario);

}  // namespace etude
