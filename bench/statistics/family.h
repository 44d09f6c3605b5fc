#pragma once

#include <span>

#include "bench/results/run_data.h"

namespace etude {

/// Corrects the deciding p-values of comparisons that were all asked together (Holm), judges each anew, and says on
/// it why its verdict is open and what else to know before believing it. One without a p counts as a question too.
void JudgeFamily(std::span<Comparison* const> family);

}  // namespace etude
