#pragma once

#include <optional>
#include <span>

#include "bench/model/summary.h"

namespace etude {

/// A comparison to be judged, and the same with failures counted as losses (CompareWithFailures).
struct Question {
  Comparison* comparison = nullptr;
  std::optional<Comparison> with_failures;
};

/// Corrects the deciding p-values of comparisons that were all asked together (Holm), judges each anew, and says on
/// it why its verdict is open and what else to know before believing it. One without a p counts as a question too.
/// Where one method alone failed, the p is the one with failures counted, and the verdict must be the same with and
/// without them.
void JudgeFamily(std::span<const Question> family);

}  // namespace etude
