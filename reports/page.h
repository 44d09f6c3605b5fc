#pragma once

#include <span>
#include <string>

#include "bench/model/run_data.h"
#include "io/real_takes/real_take.h"
#include "reports/films/media.h"

namespace etude {

/// Returns the HTML report of a run: first the verdicts, in plain words with pictures; tables of numbers are collapsed.
/// The page embeds everything except the recorded motions, which are scripts beside the page. The page's
/// Content-Security-Policy forbids network access. `real` holds captures of real films, which the page shows beside the
/// simulated captures.
std::string WritePage(const RunData& run, const Media& media, std::span<const RealTake> real = {});

/// Returns the verdicts of the page as a short Markdown text, for a pull request or a release note.
std::string WriteMarkdown(const RunData& run);

/// Returns one scenario as LaTeX floats for plain pdflatex with the package booktabs. For each condition, the floats
/// show every method's value of every headline metric, with an interval, the number of cells with a value, the paired
/// comparison with the baseline and the verdict of this comparison. Paper B's tables follow, if the cells keep the data
/// for these tables. Figures are rounded as on the page; the CSV files hold all digits.
std::string ScenarioLatex(const RunData& run, const ScenarioSummary& scenario);

/// Returns every summary of one scenario as CSV in full precision: median, interval, mean, the number of values, and
/// the number of missing values with the reasons. The share of cells that ended ok comes first, and counts failures in
/// the denominator. Fields of missing values are empty.
std::string NumberTableCsv(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
