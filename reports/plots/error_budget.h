#pragma once

#include <string>

#include "bench/model/summary.h"

namespace etude {

/// What each stage costs, as a waterfall with intervals: from the method's error down to what is left when all stages
/// are true. Says whether the shares depend on an order. `condition`: under which, in words; may be empty.
std::string ErrorBudgetHtml(const ErrorBudget& budget, const std::string& condition);

}  // namespace etude
