#pragma once

#include <string>

#include "reports/plots/paired_worlds.h"

namespace etude {

/// One comparison as an estimation plot (after Gardner & Altman 1986; paired as in Ho et al. 2019): a panel with every
/// world a dot under both methods, joined, and one with the paired differences on an axis of their own: dots, the
/// aggregate with its 95 % interval, the units' means with theirs, and shaded what does not matter. Dots are coloured
/// by unit, or by method where worlds are units. "" without worlds.
std::string EstimationHtml(const ScenarioSummary& scenario, const Judged& judged, const PairedDots& pairs);

/// Names the units' colours; "" where worlds are units.
std::string UnitLegendHtml(const PairedDots& pairs);

}  // namespace etude
