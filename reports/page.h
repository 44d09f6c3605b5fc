#pragma once

#include <span>
#include <string>

#include "bench/model/run_data.h"
#include "io/real_takes/real_take.h"
#include "reports/films/media.h"

namespace etude {

/// Writes the page that shows a run to people: verdict first, plain words, pictures; numbers folded away. It holds
/// everything it needs, and forbids itself the network. `real`: captures of real films, shown beside the simulated
/// ones.
std::string WritePage(const RunData& run, const Media& media, std::span<const RealTake> real = {});

/// Writes the page's verdicts as a short Markdown text, for a pull request or a closing note.
std::string WriteMarkdown(const RunData& run);

/// Writes one scenario as LaTeX floats, for plain pdflatex with the package booktabs: per condition every headline
/// metric of every method with its interval, how many cells have it, the paired comparison with the baseline and its
/// verdict; then, where the cells keep them, paper B's tables. Figures are rounded as on the page; the CSV files hold
/// all digits.
std::string ScenarioLatex(const RunData& run, const ScenarioSummary& scenario);

/// Writes every summary of one scenario as CSV: median, interval, mean, how many values there are, how many are missing
/// and why; first the share of cells that ended ok, failures in the denominator. Full precision, empty fields for
/// values that do not exist.
std::string NumberTableCsv(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
