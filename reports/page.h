#pragma once

#include <span>
#include <string>

#include "bench/model/run_data.h"
#include "io/real_takes/real_take.h"
#include "reports/films/media.h"

namespace etude {

/// Returns the HTML report of a run: verdicts first, in plain words with pictures; tables of numbers are folded away.
/// The page loads nothing: everything is embedded, and its Content-Security-Policy forbids network access. `real` holds
/// captures of real films, shown beside the simulated ones.
std::string WritePage(const RunData& run, const Media& media, std::span<const RealTake> real = {});

/// Returns the verdicts of the page as a short Markdown text, for a pull request or a release note.
std::string WriteMarkdown(const RunData& run);

/// Returns one scenario as LaTeX floats for plain pdflatex with the package booktabs. For each condition they show
/// every headline metric of every method with its interval, the number of cells that have it, the paired comparison
/// with the baseline and its verdict; then paper B's tables, if the cells keep them. Figures are rounded as on the
/// page; the CSV files hold all digits.
std::string ScenarioLatex(const RunData& run, const ScenarioSummary& scenario);

/// Returns every summary of one scenario as CSV in full precision: median, interval, mean, the number of values, the
/// number of missing values and why. The share of cells that ended ok comes first, with failures in its denominator.
/// Fields of missing values are empty.
std::string NumberTableCsv(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
