#include "engine/transitions/choices/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace etude {

std::vector<Candidate> ListCandidates(const MotionLibrary& library, const TransitionRequest& request,
                                      const MatchRules& rules, const RankedPair& taken, std::vector<RankedPair> others,
                                      CandidateOutcome passed_over) {
  std::sort(others.begin(), others.end(), [](const RankedPair& a, const RankedPair& b) {
    return std::tuple(!a.matches, a.rank, a.from, a.to) < std::tuple(!b.matches, b.rank, b.from, b.to);
  });
  others.resize(std::min(others.size(), kMostCandidates - 1));
  std::vector<Candidate> candidates;
  const auto add = [&](const RankedPair& pair, CandidateOutcome outcome) {
    const Grades &from = library.tagged[request.from].grades[pair.from],
                 &to = library.tagged[request.to].grades[pair.to];
    candidates.push_back({.from_frame = pair.from,
                          .to_frame = pair.to,
                          .distance = ComputeDistance(from, to, rules.weights),
                          .cost = pair.cost,
                          .outcome = outcome});
  };
  add(taken, CandidateOutcome::kTaken);
  for (const RankedPair& pair : others) add(pair, pair.matches ? passed_over : CandidateOutcome::kTooFar);
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tuple(a.from_frame, a.to_frame) < std::tuple(b.from_frame, b.to_frame);
  });
  return candidates;
}

std::string DescribeNoMatch(const std::vector<RankedPair>& nearest, std::int64_t pairs, std::string_view frames,
                            const MatchRules& rules) {
  if (nearest.empty()) return fmt::format("no two of {} pairs of {} have the same tags", pairs, frames);
  const double least = std::ranges::min_element(nearest, {}, &RankedPair::rank)->rank;
  return fmt::format("no match among {} pairs of {}: the nearest has d = {:.2f}, not below {:g}", pairs, frames, least,
                     rules.threshold);
}

std::string DescribePair(const MotionLibrary& library, const TransitionRequest& request, int from, int to) {
  const double wait_s = (from - request.request_frame) / library.tagged[request.from].rate_hz;
  return fmt::format("{} frame {} ({:.2f} s after the request) and {} frame {}", library.names[request.from], from,
                     wait_s, library.names[request.to], to);
}

}  // namespace etude
