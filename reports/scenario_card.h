#pragma once

#include <optional>
#include <string>

#include "bench/model/run_data.h"
#include "reports/films/media.h"
#include "reports/words/findings.h"

namespace etude {

/// A chart of numbers: the data for assets/report.js, and a description in words for readers who cannot see it.
struct Chart {
  std::string caption;      ///< names the quantity and its unit
  std::string description;  ///< the figures in words
  std::string json;         ///< not yet escaped for HTML
  bool is_wide = false;     ///< takes the full width of the page
};

/// Returns the chart of the methods' errors over iterations, or over frames if the methods follow a motion: for each
/// method the median over its cells. Over frames, it shows the first condition only, because other conditions may have
/// other frames. Returns nothing if the run kept no such curves.
std::optional<Chart> CurveChart(const RunData& run, const ScenarioSummary& scenario);

/// Returns a film with its caption as HTML: a <figure> with <video>. Without a film, the figure has the poster and the
/// reason, or only the reason; "" if there is neither.
std::string FilmElement(const Film& film, bool plays_at_once);

/// Returns the anchor of a scenario's card. `index` is the scenario's index in the run.
std::string CardAnchor(std::size_t index);

/// Returns one scenario as HTML: its question, the answer, a chart, the expectations, the failures, and all numbers.
/// Shows the pictures and films of `media` that belong to this scenario.
std::string WriteScenarioCard(const RunData& run, std::size_t index, const ScenarioFindings& findings,
                              const Media& media);

}  // namespace etude
