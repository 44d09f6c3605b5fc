#pragma once

#include <string>

#include "bench/model/summary.h"

namespace etude {

/// What holds under every value of the parameters that verdicts must hold for (`across`), a row per comparison: the
/// common verdict, or what differs. "" where nothing was asked to.
std::string AcrossTableHtml(const ScenarioSummary& scenario);

/// The same as a Markdown table.
std::string AcrossTableMarkdown(const ScenarioSummary& scenario);

}  // namespace etude
