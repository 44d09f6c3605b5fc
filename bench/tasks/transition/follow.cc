#include "bench/tasks/transition/follow.h"

#include <algorithm>
#include <cassert>
#include <span>

#include "engine/bridging/alignment.h"

namespace etude {
namespace {

BodyPose StepBack(const BodyPose& first, const BodyPose& second) {
  BodyPose before;
  for (std::size_t i = 0; i < kRoleCount; ++i) before.joints[i] = 2.0 * first.joints[i] - second.joints[i];
  return before;
}

/// Shows `from` up to the frame left, then the frames of `between` as they are (one at least), then what follows the
/// frame entered of `to`, laid on the last of them. Both ends of `between` are seams; for the first, the frame that
/// would stand in the left one's place is what the new motion comes from at a steady speed.
Splice SpliceBetween(const BodyMotion& from, const BodyMotion& to, const Switch& change,
                     std::span<const BodyPose> between) {
  assert(!between.empty());
  const int left = change.from_frame, entered = change.to_frame;
  Splice splice;
  splice.motion.rate_hz = from.rate_hz;
  std::vector<BodyPose>& shown = splice.motion.poses;
  shown.assign(from.poses.begin(), from.poses.begin() + left + 1);
  shown.insert(shown.end(), between.begin(), between.end());
  const FloorMove place = AlignOnFloor(to.poses[entered], between.back());
  for (std::size_t frame = entered + 1; frame < to.poses.size(); ++frame) shown.push_back(place.Apply(to.poses[frame]));

  Seam into;
  into.frame = left;
  into.leaving_before = shown[std::max(left - 1, 0)];
  into.leaving = shown[left];
  into.arriving = StepBack(shown[left + 1], shown[left + 2]);
  into.arriving_after = shown[left + 1];
  Seam out;
  out.frame = left + static_cast<int>(between.size());
  out.leaving_before = shown[out.frame - 1];
  out.leaving = shown[out.frame];
  out.arriving = place.Apply(to.poses[entered]);
  out.arriving_after = shown[out.frame + 1];
  splice.seams = {into, out};
  return splice;
}

/// As PlanTransition would have told it, but for the wait, which is measured on the outcome (ScoreSwitch).
Transition PlanOf(const SwitchAnswer& answer, const Stage& stage, const SwitchRequest& request) {
  Transition plan;
  plan.request_frame = request.request_frame;
  plan.switches = answer.switches;
  for (Switch& change : plan.switches) {
    change.distance = ComputeDistance(stage.tagged[change.from_clip].grades[change.from_frame],
                                      stage.tagged[change.to_clip].grades[change.to_frame], PaperWeights());
  }
  const Switch& last = plan.switches.back();
  const bool is_front = last.to_frame < stage.tagged[last.to_clip].FrameCount() / 2;
  const bool is_direct = plan.switches.size() == 1 && answer.between.empty();
  plan.branch = !is_direct ? Branch::kInBetween : is_front ? Branch::kFrontHalf : Branch::kRearHalf;
  return plan;
}

}  // namespace

SwitchOutcome FollowAnswer(const SwitchAnswer& answer, const Stage& stage, const SwitchRequest& request) {
  SwitchOutcome outcome{.matched = answer.matched, .weights = PaperWeights(), .plan = {}, .splice = {}};
  outcome.between_frames = static_cast<int>(answer.between.size());
  outcome.plan = PlanOf(answer, stage, request);
  const std::vector<Switch>& switches = outcome.plan.switches;
  outcome.splice = answer.between.empty() ? SpliceClips(stage.motions, switches, answer.join)
                                          : SpliceBetween(stage.motions[request.from], stage.motions[request.to],
                                                          switches.front(), answer.between);
  return outcome;
}

}  // namespace etude
