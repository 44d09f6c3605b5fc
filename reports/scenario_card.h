#pragma once

#include <optional>
#include <string>

#include "bench/model/run_data.h"
#include "reports/films/media.h"
#include "reports/words/findings.h"

namespace etude {

/// A chart of curves: the data for assets/report.js, and a description in words for readers who cannot see the chart.
struct Chart {
  std::string caption;      ///< names the quantity on the vertical axis and the quantity's unit
  std::string description;  ///< states the charted numbers in words
  std::string json;         ///< data for assets/report.js, not yet escaped for HTML
  bool is_wide = false;     ///< true: the chart takes the full width of the page
};

/// Returns the chart of each method's median error over iterations, or over frames if the methods follow a motion. The
/// median is taken over the method's cells. A chart over frames shows the first condition only, because the motions of
/// other conditions may differ. Returns nullopt if the run kept no such curves.
std::optional<Chart> CurveChart(const RunData& run, const ScenarioSummary& scenario);

/// Returns a film with its caption as HTML: a <figure> with <video>. If there is no film, the figure has the poster (if
/// any) and the reason why there is no film. Returns "" if there is no reason either.
std::string FilmElement(const Film& film, bool plays_at_once);

/// Returns the anchor of a scenario's card. `index` is the scenario's index in the run.
std::string CardAnchor(std::size_t index);

/// Returns the card of one scenario as HTML: the question, the answer, a chart, the expectations, the failures, and all
/// numbers. Shows the pictures and films in `media` that belong to this scenario.
std::string WriteScenarioCard(const RunData& run, std::size_t index, const ScenarioFindings& findings,
                              const Media& media);

}  // namespace etude
