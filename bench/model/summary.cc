#include "bench/model/summary.h"

namespace etude {

std::string_view IntervalKindName(IntervalKind kind) { return NameOfValue(kIntervalKinds, kind); }
std::string_view VerdictName(Verdict verdict) { return NameOfValue(kVerdicts, verdict); }
std::string_view ClaimOutcomeName(ClaimOutcome outcome) { return NameOfValue(kClaimOutcomes, outcome); }

}  // namespace etude
