#include "bench/metrics/matching.h"

#include "bench/statistics/curves/curves.h"

namespace etude {

std::optional<double> MatchingShare(const MatchTally& tally) { return Share(tally.matching, tally.pairs); }

std::optional<double> FalseSmoothShare(const MatchTally& tally) { return Share(tally.falsely_smooth, tally.matching); }

double MeanJointDistanceCm(const BodyPose& a, const BodyPose& b) {
  double sum = 0;
  for (Role role : AllRoles()) sum += glm::distance(a[role], b[role]);
  return 100 * sum / static_cast<double>(kRoleCount);
}

}  // namespace etude
