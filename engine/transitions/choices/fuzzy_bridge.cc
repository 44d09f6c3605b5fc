#include "engine/transitions/choices/fuzzy_bridge.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "engine/transitions/choices/planning.h"
#include "engine/transitions/choices/through_in_between.h"
#include "engine/transitions/library/transition_points.h"

namespace etude {
namespace {

/// Every pair of bridge frames that the budget allows: those behind the first match, too, which the search never saw.
struct PairSurvey {
  AllowedFrames allowed;
  std::int64_t matching = 0;
  std::int64_t nearer = 0;          ///< matching ones that are nearer than the taken pair
  std::vector<RankedPair> nearest;  ///< for each bridge frame that may be left: its nearest but the taken pair
};

PairSurvey SurveyPairs(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules,
                       const std::optional<TransitionPoint>& taken) {
  PairSurvey survey{.allowed = AllowedBridgeFrames(library, request), .nearest = {}};
  FuzzyGate gate(library.tagged[request.from], library.tagged[request.to], survey.allowed.enter, rules);
  for (int from : survey.allowed.leave) {
    std::optional<RankedPair> nearest;
    for (const auto& [to, distance, matches] : gate.Compare(from)) {
      survey.matching += matches;
      survey.nearer += matches && taken && distance < taken->distance.value;
      if (taken && taken->from == from && taken->to == to) continue;
      if (!nearest || distance < nearest->rank) nearest = {from, to, matches, distance, std::nullopt};
    }
    if (nearest) survey.nearest.push_back(*nearest);
  }
  return survey;
}

std::string WhyTaken(const std::string& pair, const TransitionPoint& point, bool is_rear, const PairSurvey& survey,
                     const MatchRules& rules) {
  if (rules.pick == Pick::kFirst) {
    return fmt::format("first match: {}, d = {:.2f} < {:g}; of {} matching pairs {} nearer ones came later", pair,
                       point.distance.value, rules.threshold, survey.matching, survey.nearer);
  }
  return fmt::format("smallest distance{}: {}, d = {:.2f} < {:g}, of {} matching pairs",
                     is_rear ? ", in the rear half as none matches in the front half" : " in the front half", pair,
                     point.distance.value, rules.threshold, survey.matching);
}

std::string WhyNone(const MotionLibrary& library, const TransitionRequest& request, const PairSurvey& survey,
                    const MatchRules& rules) {
  if (survey.allowed.leave.empty()) {
    return fmt::format("{} has no bridge frame within {:g} s", library.names[request.from], request.budget_s);
  }
  if (survey.allowed.enter.empty()) return fmt::format("{} has no bridge frame to enter at", library.names[request.to]);
  return DescribeNoMatch(survey.nearest, survey.allowed.Pairs(), "bridge frames", rules);
}

}  // namespace

TransitionRecord PlanFuzzyBridge(const MotionLibrary& library, const TransitionRequest& request,
                                 const MatchRules& rules) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const FrameWindow window = WaitWindow(playing, request.request_frame, request.budget_s);
  const std::optional<TransitionPoint> point = FindTransitionPoint(playing, window, next, rules);
  const PairSurvey survey = SurveyPairs(library, request, rules, point);
  if (!point) {
    return ThroughInBetween(library, request, rules, WhyNone(library, request, survey, rules), survey.allowed.Pairs());
  }
  TransitionRecord record = DirectTransition(library, request, point->from, point->to, rules);
  record.pairs_seen = survey.allowed.Pairs();
  record.pairs_matched = survey.matching;
  const RankedPair taken{.from = point->from, .to = point->to, .matches = true, .cost = std::nullopt};
  record.candidates = ListCandidates(library, request, rules, taken, survey.nearest,
                                     rules.pick == Pick::kFirst ? CandidateOutcome::kLater : CandidateOutcome::kWorse);
  record.why = WhyTaken(DescribePair(library, request, point->from, point->to), *point,
                        record.branch == Branch::kRearHalf, survey, rules);
  return record;
}

}  // namespace etude
