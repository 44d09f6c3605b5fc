#include "engine/transitions/choices/matching.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "engine/transitions/choices/pair_rows.h"
#include "engine/transitions/choices/planning.h"
#include "engine/transitions/choices/through_in_between.h"
#include "engine/transitions/transition_record.h"

namespace etude {
namespace {

/// The pairs to rank, and the name and unit of the cost that ranks them.
struct Ranking {
  AllowedFrames allowed;
  std::string name;  ///< for example "point-cloud distance"
  std::string unit;  ///< for example "cm"
  /// If true, only pairs that match by the rules are ranked. If none matches, the plan goes through an in-between.
  bool gated = false;
};

bool IsBetter(const RankedPair& a, const RankedPair& b) {
  return std::tuple(!a.matches, a.rank) < std::tuple(!b.matches, b.rank);
}

struct RankedPairs {
  std::vector<RankedPair> best;  ///< the best pair of each frame at which the playing clip may be left
  std::int64_t matching = 0;     ///< number of matching pairs
};

/// Ranks all allowed pairs by their cost. If `gate` is null, every pair matches.
RankedPairs RankPairs(const AllowedFrames& allowed, FuzzyGate* gate, PairRows& costs) {
  RankedPairs survey;
  std::vector<double> row;
  std::vector<int> passing = allowed.enter;
  for (int from : allowed.leave) {
    std::optional<RankedPair> best;
    // Let the gate select the frames to enter. Keep the nearest rejected frame for the report.
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
    // Rank the remaining frames by their cost.
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

/// Takes the allowed pair with the lowest cost; of equally cheap pairs, the earliest.
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

  // Record the taken pair and the best of the other pairs.
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

class MotionFeatureRows : public PairRows {
 public:
  MotionFeatureRows(std::span<const MotionFeatures> playing, std::span<const MotionFeatures> next)
      : playing_(playing), next_(next) {}

  void Compute(int leave_frame, std::span<const int> enter_frames, std::span<double> costs) override {
    const MotionFeatures& leaving = playing_[leave_frame];
    for (std::size_t i = 0; i < enter_frames.size(); ++i) {
      const MotionFeatures& entering = next_[enter_frames[i]];
      double squares = 0;
      for (std::size_t k = 0; k < kMotionFeatureCount; ++k) {
        const double gap = leaving[k] - entering[k];
        squares += gap * gap;
      }
      costs[i] = std::sqrt(squares);
    }
  }

 private:
  std::span<const MotionFeatures> playing_, next_;
};

TransitionRecord PlanByPointCloud(const MotionLibrary& library, const TransitionRequest& request,
                                  const MatchRules& rules, const PointCloudOptions& options, bool gated) {
  PointCloudRows costs(library.motions[request.from], library.motions[request.to], request.request_frame,
                       options.window_s);
  const Ranking ranking{.allowed = AllowedAnyFrames(library, request, options.least_play_s),
                        .name = "point-cloud distance",
                        .unit = "cm",
                        .gated = gated};
  return PlanRanked(library, request, rules, ranking, costs);
}

/// Returns the description of the setting `least_play_s`, which all choices of this file have.
template <typename Options>
typename SettingTable<Options>::Row LeastPlay() {
  return {"least_play_s", &Options::least_play_s, 0, 60,
          "Minimum time, in seconds, that the wanted clip must still play after the transition. The front half of the "
          "wanted clip may always be entered."};
}

}  // namespace

const SettingTable<PointCloudOptions>& PointCloudSettings() {
  static const SettingTable<PointCloudOptions> kSettings({LeastPlay<PointCloudOptions>()});
  return kSettings;
}

TransitionRecord PlanFuzzyKovar(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                                const PointCloudOptions& options) {
  return PlanByPointCloud(library, request, rules, options, true);
}

TransitionRecord PlanPointCloud(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                                const PointCloudOptions& options) {
  return PlanByPointCloud(library, request, rules, options, false);
}

const SettingTable<MotionMatchingOptions>& MotionMatchingSettings() {
  static const SettingTable<MotionMatchingOptions> kSettings({LeastPlay<MotionMatchingOptions>()});
  return kSettings;
}

TransitionRecord PlanMotionMatching(const MotionLibrary& library, const TransitionRequest& request,
                                    const MatchRules& rules, const MotionMatchingOptions& options) {
  MotionFeatureRows costs(library.features[request.from], library.features[request.to]);
  const Ranking ranking{.allowed = AllowedAnyFrames(library, request, options.least_play_s),
                        .name = "distance of positions and velocities",
                        .unit = "SD"};
  return PlanRanked(library, request, rules, ranking, costs);
}

const SettingTable<FuzzyWindowOptions>& FuzzyWindowSettings() {
  static const SettingTable<FuzzyWindowOptions> kSettings({LeastPlay<FuzzyWindowOptions>()});
  return kSettings;
}

TransitionRecord PlanFuzzyWindow(const MotionLibrary& library, const TransitionRequest& request,
                                 const MatchRules& rules, const FuzzyWindowOptions& options) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const int reach = static_cast<int>(std::lround(options.reach_s * playing.rate_hz));
  FuzzyWindowRows costs(playing.grades, next.grades, request.request_frame, reach, rules.weights);
  const Ranking ranking{.allowed = AllowedAnyFrames(library, request, options.least_play_s),
                        .name = "mean fuzzy distance",
                        .unit = "d",
                        .gated = true};
  return PlanRanked(library, request, rules, ranking, costs);
}

}  // namespace etude
