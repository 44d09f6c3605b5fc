#pragma once

#include <string>

#include "bench/model/run_data.h"
#include "reports/films/media.h"
#include "reports/words/findings.h"

namespace etude {

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
