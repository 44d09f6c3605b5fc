#include "engine/transitions/choices/choice.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <utility>

#include "engine/base/named.h"
#include "engine/transitions/choices/matching.h"
#include "engine/transitions/choices/played.h"
#include "engine/transitions/choices/through_in_between.h"
#include "engine/transitions/library/in_betweens.h"
#include "engine/transitions/library/transition_points.h"

namespace etude {
namespace {

/// Statistics of all pairs of bridge frames within the budget. The pairs after the first match count, too, although the
/// search itself skips them.
struct PairSurvey {
  AllowedFrames allowed;
  std::int64_t matching = 0;
  std::int64_t nearer = 0;          ///< number of matching pairs with a smaller distance than the taken pair
  std::vector<RankedPair> nearest;  ///< for each frame that may be left: its nearest pair, except the taken pair
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
    return fmt::format(
        "the first match: {}, with the distance d = {:.2f} < {:g}; {} pairs match, and {} of them have a smaller "
        "distance but come later",
        pair, point.distance.value, rules.threshold, survey.matching, survey.nearer);
  }
  return fmt::format(
      "the smallest distance{}: {}, with d = {:.2f} < {:g}, among {} matching pairs",
      is_rear ? " in the rear half of the clip, because no pair matches in the front half" : " in the front half", pair,
      point.distance.value, rules.threshold, survey.matching);
}

std::string WhyNone(const MotionLibrary& library, const TransitionRequest& request, const PairSurvey& survey,
                    const MatchRules& rules) {
  if (survey.allowed.leave.empty()) {
    return fmt::format("the clip {} has no bridge frame within {:g} s", library.names[request.from], request.budget_s);
  }
  if (survey.allowed.enter.empty())
    return fmt::format("the clip {} has no bridge frame at which a transition may enter it", library.names[request.to]);
  return DescribeNoMatch(survey.nearest, survey.allowed.Pairs(), "bridge frames", rules);
}

/// Plans paper A's transition (section 3.5). Compares each bridge frame of the playing clip within the budget with the
/// bridge frames of the wanted clip's front half, then of its rear half, and takes the first pair that matches. With
/// Pick::kSmallest it takes the nearest matching pair of the front half, or of the rear half if no pair of the front
/// half matches. If no pair matches at all, the transition goes through an in-between.
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

/// Plans an immediate transition into the wanted clip's first frame, regardless of the poses.
TransitionRecord PlanNow(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules) {
  TransitionRecord record = DirectTransition(library, request, request.request_frame, 0, rules);
  record.branch = Branch::kNow;
  record.why = fmt::format("the transition goes at once into the first frame, whatever the poses are; d = {:.2f}",
                           record.distances[0].value);
  return record;
}

/// Plans a transition from the playing clip's last frame into the wanted clip's first frame, regardless of the budget.
/// A player without bridging does this (paper A, section 1).
TransitionRecord PlanWaitForEnd(const MotionLibrary& library, const TransitionRequest& request,
                                const MatchRules& rules) {
  const int end = library.tagged[request.from].FrameCount() - 1;
  TransitionRecord record = DirectTransition(library, request, end, 0, rules);
  record.branch = Branch::kEnd;
  record.why = fmt::format("the playing clip ended after {:.2f} s; the distance to the first frame is d = {:.2f}",
                           record.wait_s, record.distances[0].value);
  return record;
}

/// Plans unbroken motion, as a reference for measures: the playing clip continues, every join leaves it unchanged, and
/// the wanted clip is ignored. The record has one transition point, at which the playing clip is left and entered again
/// at the request's frame. Measures therefore evaluate unbroken motion at the frames at which other choices change
/// clips.
///
/// If the request comes at the clip's last frame, the clip cannot continue, and the record has no segments.
TransitionRecord PlanUnbroken(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules) {
  const TaggedClip& playing = library.tagged[request.from];
  const int frame = request.request_frame, last = playing.FrameCount() - 1;
  TransitionRecord record;
  record.request_frame = frame;
  if (frame >= last) {
    record.why = fmt::format("the clip {} has no frames left", library.names[request.from]);
    return record;
  }
  record.branch = Branch::kUnbroken;
  record.segments = {{.clip = request.from, .first = frame, .last = frame, .own = {}},
                     {.clip = request.from, .first = frame, .last = last, .own = {}}};
  record.distances = {ComputeDistance(playing.grades[frame], playing.grades[frame], rules.weights)};
  record.why = fmt::format("the clip {} continues without a transition, for comparison", library.names[request.from]);
  return record;
}

/// Plans a transition as games make it, according to paper A (section 1: all their clips begin and end standing). The
/// playing clip is left at once. One tween leads into a standing pose, a second tween from there into the wanted clip's
/// first frame. The budget is ignored: the rules of tweens determine how long the tweens last.
TransitionRecord PlanThroughStanding(const MotionLibrary& library, const TransitionRequest& request,
                                     const MatchRules& rules) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const TweenRules& tween = library.in_betweens.tween;
  const BodyPose& leaving = library.motions[request.from].poses[request.request_frame];
  const BodyPose& entered = library.motions[request.to].poses.front();
  // Compute the frames of both tweens: into the standing pose, and from there into the wanted clip.
  std::vector<BodyPose> own = SampleTween(Tween(leaving, StandingPose(library.proportions)), playing.rate_hz, tween);
  const int standing = static_cast<int>(own.size()) - 1;
  AppendTween(entered, playing.rate_hz, tween, own);

  // The record has three segments: the playing clip's frame at the request, the tweens, and the wanted clip.
  TransitionRecord record;
  record.branch = Branch::kStandingPose;
  record.request_frame = request.request_frame;
  const int last = static_cast<int>(own.size()) - 1;
  record.segments = {{.clip = request.from, .first = request.request_frame, .last = request.request_frame, .own = {}},
                     {.clip = Segment::kOwnFrames, .first = 0, .last = last, .own = std::move(own)},
                     {.clip = request.to, .first = 0, .last = next.FrameCount() - 1, .own = {}}};
  // The tweens begin and end at the clips' own frames, so each transition point compares a frame with itself.
  const auto to_itself = [&](const Grades& grades) { return ComputeDistance(grades, grades, rules.weights); };
  record.distances = {to_itself(playing.grades[request.request_frame]), to_itself(next.grades.front())};
  record.wait_s = WaitOf(record.segments, playing.rate_hz);
  record.why = fmt::format(
      "the transition starts at once: {:.2f} s into a standing pose, then {:.2f} s into the first frame of {}",
      standing / playing.rate_hz, (last - standing) / playing.rate_hz, library.names[request.to]);
  return record;
}

using Library = const MotionLibrary&;
using Request = const TransitionRequest&;
using Rules = const MatchRules&;
using Values = std::span<const double>;

/// Adapts the plan function of a choice without settings to a table row.
template <auto Plan>
TransitionRecord PlanBy(Library library, Request request, Rules rules, Values /*values*/) {
  return Plan(library, request, rules);
}

/// Adapts the plan function of a choice with settings to a table row; the settings are read from `values`.
template <auto Plan, auto Settings>
TransitionRecord PlanWith(Library library, Request request, Rules rules, Values values) {
  return Plan(library, request, rules, Settings().Apply(values));
}

template <auto Settings>
AllowedFrames AnyFramesWith(Library library, Request request, Values values) {
  return AllowedAnyFrames(library, request, Settings().Apply(values).least_play_s);
}

AllowedFrames BridgeFrames(Library library, Request request, Values /*values*/) {
  return AllowedBridgeFrames(library, request);
}

/// Makes the table row of a choice that ranks all pairs of frames.
template <auto Plan, auto Settings>
Choice Ranked(const char* name, const char* description, bool uses_fuzzy) {
  return {.name = name,
          .description = description,
          .matches_poses = true,
          .uses_fuzzy = uses_fuzzy,
          .settings = Settings().Describe(),
          .allowed = AnyFramesWith<Settings>,
          .plan = PlanWith<Plan, Settings>};
}

// Returns the table of choices. The table is made on the first call; by then the strings that it uses are initialised.
std::span<const Choice> Table() {
  static const std::array kChoices = {
      // Choices that search for good frames.
      Choice{.name = "fuzzy-bridge",
             .description = "paper A's method: takes the first bridge frames that match; if none match, goes through "
                            "an in-between clip",
             .matches_poses = true,
             .uses_fuzzy = true,
             .allowed = BridgeFrames,
             .plan = PlanBy<PlanFuzzyBridge>},
      Ranked<PlanFuzzyKovar, PointCloudSettings>(
          "fuzzy-kovar",
          "among all matching bridge frames, takes the pair with the smallest point-cloud distance (Kovar 2002)", true),
      Ranked<PlanFuzzyWindow, FuzzyWindowSettings>("fuzzy-window",
                                                   "among all matching bridge frames, takes the pair with the smallest "
                                                   "mean fuzzy distance in a window around the pair",
                                                   true),
      Ranked<PlanPointCloud, PointCloudSettings>(
          "point-cloud", "takes the pair of frames with the smallest point-cloud distance (Kovar 2002)", false),
      Ranked<PlanMotionMatching, MotionMatchingSettings>("motion-matching",
                                                         "takes the pair of frames with the most similar positions and "
                                                         "velocities of hands, feet and hips (Clavet 2016)",
                                                         false),
      Choice{.name = "played",
             .description =
                 "takes the frames and the blend length whose transition costs the least waiting time and acceleration",
             .settings = PlayedSettings().Describe(),
             .plan = PlanWith<PlanPlayed, PlayedSettings>},
      // Choices of fixed frames, for comparison.
      Choice{.name = "through-standing",
             .description = "leaves the playing clip at once, and goes through a standing pose into the first frame of "
                            "the wanted clip",
             .plan = PlanBy<PlanThroughStanding>},
      Choice{.name = "now",
             .description = "leaves the playing clip at once, into the first frame of the wanted clip",
             .plan = PlanBy<PlanNow>},
      Choice{.name = "wait-for-end",
             .description = "goes from the last frame of the playing clip into the first frame of the wanted clip",
             .plan = PlanBy<PlanWaitForEnd>},
      Choice{.name = "unbroken",
             .description = "makes no transition: the playing clip continues, as a reference for unbroken motion",
             .plan = PlanBy<PlanUnbroken>},
  };
  return kChoices;
}

}  // namespace

std::span<const Choice> AllChoices() { return Table(); }

std::vector<std::string> ChoiceNames() { return NamesOf(AllChoices()); }
const Choice* FindChoice(std::string_view name) { return FindByName(AllChoices(), name); }

Transition MakeTransition(const MotionLibrary& library, const TransitionRequest& request, const TransitionWay& way) {
  Transition made{way.choice->plan(library, request, way.rules, way.choice_settings), {}};
  if (!made.record.segments.empty()) {
    made.splice = SpliceSegments(library.motions, made.record.segments, *way.join, way.join_settings);
  }
  return made;
}

}  // namespace etude
