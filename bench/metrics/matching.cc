#include "bench/metrics/matching.h"

#include "bench/statistics/curves/curves.h"

namespace etude {

std::optional<double> MatchingShare(const MatchTally& tally) { return Share(tally.matching, tally.pairs); }

std::optional<double> FalseSmoothShare(const MatchTally& tally) { return Share(tally.falsely_smooth, tally.matching); }

}  // namespace etude
