#pragma once

#include <string>

#include "reports/films/media.h"
#include "reports/words/findings.h"

namespace etude {

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
