#include "engine/transitions/choices/ranked.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

#include "engine/transitions/choices/direct.h"
#include "engine/transitions/choices/explain.h"
#include "engine/transitions/choices/fuzzy_gate.h"
#include "engine/transitions/choices/through_in_between.h"

namespace etude {
namespace {

bool IsBetter(const RankedPair& a, const RankedPair& b) {
  return std::tuple(!a.matches, a.rank) < std::tuple(!b.matches, b.rank);
}

/// The best pair of each row, and how many matched on the way.
struct RankedPairs {
  std::vector<RankedPair> best;
  std::int64_t matching = 0;
};

/// Without a gate every pair matches.
RankedPairs RankPairs(const AllowedFrames& allowed, FuzzyGate* gate, PairRows& costs) {
  RankedPairs survey;
  std::vector<double> row;
  std::vector<int> passing = allowed.enter;
  for (int from : allowed.leave) {
    std::optional<RankedPair> best;
    if (gate != nullptr) {
      passing.clear();
      for (const auto& [to, distance, matches] : gate->Compare(from)) {
        if (matches) {
          passing.push_back(to);
        } else if (!best || distance < best->rank) {
          best = {from, to, false, distance, std::nullopt};
        }
      }
    }
    row.resize(passing.size());
    if (!passing.empty()) costs.Compute(from, passing, row);
    for (std::size_t i = 0; i < passing.size(); ++i) {
      if (!best || !best->matches || row[i] < best->rank) best = {from, passing[i], true, row[i], row[i]};
    }
    if (best) survey.best.push_back(*best);
    survey.matching += static_cast<std::int64_t>(passing.size());
  }
  return survey;
}

}  // namespace

TransitionRecord PlanRanked(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                            const Ranking& ranking, PairRows& costs) {
  const std::int64_t pairs = ranking.allowed.Pairs();
  std::optional<FuzzyGate> gate;
  if (ranking.gated) {
    gate.emplace(library.tagged[request.from], library.tagged[request.to], ranking.allowed.enter, rules);
  }
  RankedPairs survey = RankPairs(ranking.allowed, gate ? &*gate : nullptr, costs);
  const auto best = std::min_element(survey.best.begin(), survey.best.end(), IsBetter);
  if (best == survey.best.end() || !best->matches) {
    return ThroughInBetween(library, request, rules, DescribeNoMatch(survey.best, pairs, "frames", rules), pairs);
  }
  const RankedPair taken = *best;
  survey.best.erase(best);

  TransitionRecord record = DirectTransition(library, request, taken.from, taken.to, rules);
  record.pairs_seen = pairs;
  record.pairs_matched = survey.matching;
  record.cost_unit = ranking.unit;
  record.candidates = ListCandidates(library, request, rules, taken, std::move(survey.best), CandidateOutcome::kWorse);
  const std::string among = ranking.gated
                                ? fmt::format("{} pairs with d < {:g}, of {}", survey.matching, rules.threshold, pairs)
                                : fmt::format("{} pairs", pairs);
  record.why = fmt::format("smallest {} of {}: {}, {:.2f} {}, d = {:.2f}", ranking.name, among,
                           DescribePair(library, request, taken.from, taken.to), *taken.cost, ranking.unit,
                           record.distances.front().value);
  return record;
}

}  // namespace etude
