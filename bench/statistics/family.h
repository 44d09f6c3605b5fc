#pragma once

#include <optional>
#include <span>

#include "bench/model/summary.h"

namespace etude {

/// A comparison to be judged, and the same with failures counted as losses (WithFailures).
struct Question {
  Comparison comparison;
  std::optional<Comparison> with_failures;
};

/// Corrects the deciding p-values of comparisons that were all asked together (Holm), judges each anew, and says on
/// it why its verdict is open and what else to know before believing it. One without a p counts as a question too.
/// Where one method alone failed, the p is the one with failures counted, and the verdict must be the same with and
/// without them. The verdicts beyond these worlds are a family of their own, judged alike; where every world is its
/// own `unit` they are those on these worlds.
void JudgeFamily(std::span<Question* const> family, SamplingUnit unit = SamplingUnit::kWorld);

}  // namespace etude
