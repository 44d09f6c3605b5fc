#include "bench/metrics/matching.h"

#include <cassert>
#include <numeric>

#include "bench/statistics/curves/curves.h"

namespace etude {

std::optional<double> MatchingShare(const MatchTally& tally) { return Share(tally.matching, tally.pairs); }

std::optional<double> FalseSmoothShare(const MatchTally& tally) { return Share(tally.falsely_smooth, tally.matching); }

double MeanJointDistanceCm(const BodyPose& a, const BodyPose& b) {
  double sum = 0;
  for (Role role : AllRoles()) sum += glm::distance(a[role], b[role]);
  return 100 * sum / static_cast<double>(kRoleCount);
}

std::optional<double> SearchAgreement(const std::vector<FoundFrames>& found, const std::vector<FoundFrames>& truth) {
  assert(found.size() == truth.size());
  std::int64_t same = 0;
  for (std::size_t query = 0; query < truth.size(); ++query) same += found[query] == truth[query];
  return Share(same, static_cast<std::int64_t>(truth.size()));
}

std::optional<double> MatchesPerQuery(const std::vector<FoundFrames>& found) {
  std::vector<std::int64_t> sizes;
  for (const FoundFrames& frames : found) sizes.push_back(static_cast<std::int64_t>(frames.size()));
  return MeanPerQuery(sizes);
}

std::optional<double> MeanPerQuery(std::span<const std::int64_t> counts) {
  return Share(std::accumulate(counts.begin(), counts.end(), std::int64_t{0}),
               static_cast<std::int64_t>(counts.size()));
}

}  // namespace etude
