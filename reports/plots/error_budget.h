#pragma once

#include <string>

#include "bench/model/summary.h"

namespace etude {

/// Draws the cost of each stage as a waterfall with intervals: from the method's error down to what is left when all
/// stages are true. Says whether the shares depend on an order. `condition` is in words and may be empty.
std::string ErrorBudgetHtml(const ErrorBudget& budget, const std::string& condition);

}  // namespace etude
