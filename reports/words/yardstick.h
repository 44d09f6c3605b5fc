#pragma once

#include <string>

#include "bench/model/summary.h"

namespace etude {

/// Whether a method is compared with none, as its scenario says (`against` itself). The first method is everyone's
/// baseline, and not meant.
bool IsComparedWithNone(const ScenarioSummary& scenario, const std::string& method);

/// Whether none is compared with it either: not a competitor, but what the others are measured by, like natural motion.
bool IsYardstick(const ScenarioSummary& scenario, const std::string& method);

/// The method's name; "natural (yardstick)".
std::string MethodLabel(const ScenarioSummary& scenario, const std::string& method);

}  // namespace etude
