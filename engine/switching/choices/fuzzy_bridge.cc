#include "engine/switching/choices/fuzzy_bridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "engine/switching/choices/direct.h"
#include "engine/switching/choices/explain.h"
#include "engine/switching/choices/fuzzy_rows.h"
#include "engine/switching/choices/through_in_between.h"

namespace etude {
namespace {

/// Every pair of bridge frames that the budget allows: those behind the first match, too, which the search never saw.
struct Survey {
  std::int64_t pairs = 0, matching = 0;
  std::int64_t nearer = 0;          ///< matching ones that are nearer than the link
  std::vector<RankedPair> nearest;  ///< for each bridge frame that may be left: its nearest but the link
};

Survey SurveyPairs(const MotionLibrary& library, const SwitchRequest& request, FrameWindow window,
                   const SwitchRules& rules, const std::optional<Link>& link) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  std::vector<int> targets;
  std::vector<Grades> grades;
  for (int to : next.bridge_frames) {
    if (to == next.FrameCount() - 1) continue;
    targets.push_back(to);
    grades.push_back(next.grades[to]);
  }
  const FuzzyRows rows(grades, rules.weights);
  const double limit = rules.threshold * rules.threshold;

  Survey survey;
  std::vector<double> squares(targets.size());
  for (int from : playing.bridge_frames) {
    if (!window.Contains(from)) continue;
    rows.Compute(playing.grades[from], squares);
    std::optional<RankedPair> nearest;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const bool comparable = !rules.within_class || playing.tags[from] == next.tags[targets[i]];
      const bool matches = comparable && squares[i] < limit;
      ++survey.pairs;
      survey.matching += matches;
      survey.nearer += matches && link && std::sqrt(squares[i]) < link->distance.value;
      if (!comparable || (link && link->from == from && link->to == targets[i])) continue;
      if (!nearest || squares[i] < nearest->rank) nearest = {from, targets[i], matches, squares[i], std::nullopt};
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
  const auto nearest = std::min_element(survey.nearest.begin(), survey.nearest.end(),
                                        [](const RankedPair& a, const RankedPair& b) { return a.rank < b.rank; });
  if (nearest == survey.nearest.end() && survey.pairs > 0) {
    return fmt::format("no two of {} pairs of bridge frames have the same tags", survey.pairs);
  }
  if (nearest == survey.nearest.end()) {
    const std::vector<int>& leaving = library.tagged[request.from].bridge_frames;
    const FrameWindow window = WaitWindow(library.tagged[request.from], request.request_frame, request.budget_s);
    const bool can_leave = std::ranges::any_of(leaving, [&](int frame) { return window.Contains(frame); });
    return can_leave
               ? fmt::format("{} has no bridge frame to enter at", library.names[request.to])
               : fmt::format("{} has no bridge frame within {:g} s", library.names[request.from], request.budget_s);
  }
  return fmt::format("no match among {} pairs of bridge frames: the nearest has d = {:.2f}, not below {:g}",
                     survey.pairs, std::sqrt(nearest->rank), rules.threshold);
}

}  // namespace

SwitchRecord PlanFuzzyBridge(const MotionLibrary& library, const SwitchRequest& request, const SwitchRules& rules) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const FrameWindow window = WaitWindow(playing, request.request_frame, request.budget_s);
  const std::optional<Link> link = FindLink(playing, window, next, rules).link;
  const Survey survey = SurveyPairs(library, request, window, rules, link);
  if (!link) {
    return ThroughInBetween(library, request, rules, WhyNone(library, request, survey, rules), survey.pairs);
  }
  SwitchRecord record = DirectSwitch(library, request, link->from, link->to, rules);
  record.pairs_seen = survey.pairs;
  record.pairs_matched = survey.matching;
  const RankedPair taken{.from = link->from, .to = link->to, .matches = true, .cost = std::nullopt};
  record.candidates = ListCandidates(library, request, rules, taken, survey.nearest,
                                     rules.pick == Pick::kFirst ? Fate::kLater : Fate::kWorse);
  record.why = WhyTaken(DescribePair(library, request, link->from, link->to), *link, record.branch == Branch::kRearHalf,
                        survey, rules);
  return record;
}

}  // namespace etude
