#include "engine/transitions/choices/fuzzy_bridge.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "engine/transitions/choices/direct.h"
#include "engine/transitions/choices/explain.h"
#include "engine/transitions/choices/fuzzy_gate.h"
#include "engine/transitions/choices/through_in_between.h"

namespace etude {
namespace {

/// Every pair of bridge frames that the budget allows: those behind the first match, too, which the search never saw.
struct Survey {
  std::size_t leaving = 0, entering = 0;  ///< bridge frames of the two clips
  std::int64_t matching = 0;
  std::int64_t nearer = 0;          ///< matching ones that are nearer than the link
  std::vector<RankedPair> nearest;  ///< for each bridge frame that may be left: its nearest but the link

  std::int64_t Pairs() const { return static_cast<std::int64_t>(leaving * entering); }
};

Survey SurveyPairs(const TaggedClip& playing, FrameWindow window, const TaggedClip& next, const SwitchRules& rules,
                   const std::optional<Link>& link) {
  const std::vector<int> leaving = BridgeFramesWithin(playing, window);
  const std::vector<int> entering = BridgeFramesWithin(next, EntryWindow(next));
  FuzzyGate gate(playing, next, entering, rules);
  Survey survey{.leaving = leaving.size(), .entering = entering.size(), .nearest = {}};
  for (int from : leaving) {
    std::optional<RankedPair> nearest;
    for (const auto& [to, distance, matches] : gate.Compare(from)) {
      survey.matching += matches;
      survey.nearer += matches && link && distance < link->distance.value;
      if (link && link->from == from && link->to == to) continue;
      if (!nearest || distance < nearest->rank) nearest = {from, to, matches, distance, std::nullopt};
    }
    if (nearest) survey.nearest.push_back(*nearest);
  }
  return survey;
}

std::string WhyTaken(const std::string& pair, const Link& link, bool is_rear, const Survey& survey,
                     const SwitchRules& rules) {
  if (rules.pick == Pick::kFirst) {
    return fmt::format("first match: {}, d = {:.2f} < {:g}; of {} matching pairs {} nearer ones came later", pair,
                       link.distance.value, rules.threshold, survey.matching, survey.nearer);
  }
  return fmt::format("smallest distance{}: {}, d = {:.2f} < {:g}, of {} matching pairs",
                     is_rear ? ", in the rear half as none matches in the front half" : " in the front half", pair,
                     link.distance.value, rules.threshold, survey.matching);
}

std::string WhyNone(const MotionLibrary& library, const SwitchRequest& request, const Survey& survey,
                    const SwitchRules& rules) {
  if (survey.leaving == 0) {
    return fmt::format("{} has no bridge frame within {:g} s", library.names[request.from], request.budget_s);
  }
  if (survey.entering == 0) return fmt::format("{} has no bridge frame to enter at", library.names[request.to]);
  return DescribeNoMatch(survey.nearest, survey.Pairs(), "bridge frames", rules);
}

}  // namespace

SwitchRecord PlanFuzzyBridge(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const FrameWindow window = WaitWindow(playing, request.request_frame, request.budget_s);
  const std::optional<Link> link = FindLink(playing, window, next, rules);
  const Survey survey = SurveyPairs(playing, window, next, rules, link);
  if (!link) {
    return ThroughInBetween(library, request, rules, WhyNone(library, request, survey, rules), survey.Pairs());
  }
  SwitchRecord record = DirectSwitch(library, request, link->from, link->to, rules);
  record.pairs_seen = survey.Pairs();
  record.pairs_matched = survey.matching;
  const RankedPair taken{.from = link->from, .to = link->to, .matches = true, .cost = std::nullopt};
  record.candidates = ListCandidates(library, request, rules, taken, survey.nearest,
                                     rules.pick == Pick::kFirst ? Fate::kLater : Fate::kWorse);
  record.why = WhyTaken(DescribePair(library, request, link->from, link->to), *link, record.branch == Branch::kRearHalf,
                        survey, rules);
  return record;
}

}  // namespace etude
