#pragma once

#include <string>

#include "bench/model/summary.h"

namespace etude {

/// All methods by all headline metrics: typical values, each with the sign of its verdict against the method's
/// baseline. Where something is swept, a row per method and condition. "" when there is but one metric, or no method.
std::string OverviewTableHtml(const ScenarioSummary& scenario);
std::string OverviewTableMarkdown(const ScenarioSummary& scenario);

}  // namespace etude
