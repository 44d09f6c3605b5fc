#include "bench/tasks/transition/outcome.h"

#include <algorithm>
#include <utility>

#include "bench/tasks/transition/exchange.h"

namespace etude {
namespace {

Grades GradesAt(const Segment& segment, int frame, const Stage& stage) {
  if (segment.clip != Segment::kOwnFrames) return stage.library.tagged[segment.clip].grades[frame];
  return Fuzzify(ComputeFeatures(segment.own[frame], stage.library.proportions.standing_hip_height),
                 stage.fuzzy.memberships);
}

/// Returns the record of an answer, in the form in which a built-in choice makes its record.
TransitionRecord RecordOf(const TransitionAnswer& answer, const Stage& stage, const TransitionRequest& request) {
  TransitionRecord record;
  record.request_frame = request.request_frame;
  record.segments = answer.segments;
  record.wait_s = WaitOf(record.segments, kJudgedRateHz);
  record.why = "an external method states this";
  for (std::size_t i = 0; i + 1 < record.segments.size(); ++i) {
    const Segment &old = record.segments[i], &next = record.segments[i + 1];
    record.distances.push_back(
        ComputeDistance(GradesAt(old, old.last, stage), GradesAt(next, next.first, stage), stage.fuzzy.weights));
  }
  const bool is_front = stage.library.tagged[request.to].InFrontHalf(record.segments.back().first);
  record.branch = record.segments.size() > 2 ? Branch::kInBetween : is_front ? Branch::kFrontHalf : Branch::kRearHalf;
  return record;
}

}  // namespace

TransitionOutcome FollowAnswer(const TransitionAnswer& answer, const Stage& stage, const TransitionRequest& request) {
  TransitionOutcome outcome{.request = request,
                            .matched = answer.matched,
                            .rules = {.weights = stage.fuzzy.weights},
                            .record = RecordOf(answer, stage, request),
                            .splice = {}};
  outcome.splice = SpliceSegments(stage.library.motions, outcome.record.segments, *answer.join);
  return outcome;
}

JoinView ViewOf(const TransitionOutcome& outcome, const Stage& stage) {
  const Splice& splice = outcome.splice;
  const Segment& playing = outcome.record.segments.front();
  const int first = splice.points.front().frame;
  std::vector<SupportingClip> between;
  for (std::size_t i = 0; i < splice.between.size(); ++i) {
    between.push_back(
        {.poses = splice.between[i], .begin = splice.points[i].frame, .left_at = splice.points[i + 1].frame});
  }
  return {.shown = splice.motion.poses,
          .left = stage.library.motions[playing.clip].poses,
          .wanted = splice.wanted,
          .request = first - (playing.last - playing.first),
          .first = first,
          .last = splice.points.back().frame,
          .rate_hz = splice.motion.rate_hz,
          .between = std::move(between)};
}

FrameWindow AroundPoints(const Splice& splice, double seconds) {
  const int reach = static_cast<int>(seconds * splice.motion.rate_hz);
  return {std::max(splice.points.front().frame - reach, 0),
          std::min(splice.points.back().frame + reach, static_cast<int>(splice.motion.poses.size()) - 1)};
}

const FuzzyDistance& WorstDistance(const TransitionRecord& record) {
  return *std::max_element(record.distances.begin(), record.distances.end(),
                           [](const FuzzyDistance& a, const FuzzyDistance& b) { return a.value < b.value; });
}

}  // namespace etude
