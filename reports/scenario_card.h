#pragma once

#include <optional>
#include <string>

#include "bench/model/run_data.h"
#include "reports/films/media.h"
#include "reports/words/findings.h"

namespace etude {

/// A picture of numbers: the data for assets/report.js, and the same in words for those who cannot see it.
struct Chart {
  std::string caption;      ///< what is drawn, with the unit
  std::string description;  ///< the figures in words
  std::string json;         ///< not yet escaped for HTML
  bool is_wide = false;     ///< needs all the page's width
};

/// Makes the chart of a method's errors over time: the median over its cells of their curves along iterations, or along
/// the frames of the first condition where methods follow a motion (others may have other frames). Nothing when the run
/// kept no such curves.
std::optional<Chart> CurveChart(const RunData& run, const ScenarioSummary& scenario);

/// Writes a film inside the page with its caption: a <figure> with <video>, else its poster and why there is no film,
/// else that reason alone, if there is any.
std::string FilmElement(const Film& film, bool plays_at_once);

/// Gives the anchor of a scenario's card, unique by its place in the run.
std::string CardAnchor(std::size_t index);

/// Writes one scenario as HTML: its question, the answer, a chart, the expectations, the failures, all numbers. `media`
/// gives its picture strip and films when they belong to this scenario.
std::string WriteScenarioCard(const RunData& run, std::size_t index, const ScenarioFindings& findings,
                              const Media& media);

}  // namespace etude
