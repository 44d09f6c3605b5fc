#include "engine/transitions/choices/plain_choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/motion/rest_body.h"
#include "engine/transitions/choices/planning.h"
#include "engine/transitions/library/in_betweens.h"

namespace etude {

TransitionRecord PlanNow(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules) {
  TransitionRecord record = DirectTransition(library, request, request.request_frame, 0, rules);
  record.branch = Branch::kNow;
  record.why = fmt::format("at once into the first frame, whatever the poses; d = {:.2f}", record.distances[0].value);
  return record;
}

TransitionRecord PlanWaitForEnd(const MotionLibrary& library, const TransitionRequest& request,
                                const MatchRules& rules) {
  const int end = library.tagged[request.from].FrameCount() - 1;
  TransitionRecord record = DirectTransition(library, request, end, 0, rules);
  record.branch = Branch::kEnd;
  record.why = fmt::format("the playing clip ended, after {:.2f} s; d = {:.2f} to the first frame", record.wait_s,
                           record.distances[0].value);
  return record;
}

TransitionRecord PlanUnbroken(const MotionLibrary& library, const TransitionRequest& request, const MatchRules& rules) {
  const TaggedClip& playing = library.tagged[request.from];
  const int frame = request.request_frame, last = playing.FrameCount() - 1;
  TransitionRecord record;
  record.request_frame = frame;
  if (frame >= last) {
    record.why = fmt::format("{} has no frame left to go on with", library.names[request.from]);
    return record;
  }
  record.branch = Branch::kUnbroken;
  record.segments = {{.clip = request.from, .first = frame, .last = frame, .own = {}},
                     {.clip = request.from, .first = frame, .last = last, .own = {}}};
  record.distances = {ComputeDistance(playing.grades[frame], playing.grades[frame], rules.weights)};
  record.why = fmt::format("{} goes on: no transition, for comparison", library.names[request.from]);
  return record;
}

BodyPose StandingPose(const BodyProportions& proportions) {
  using enum Role;
  BodyPose pose;
  pose[kHipCentre] = {0, proportions.standing_hip_height, 0};
  for (const Bone& bone : AllBones()) {
    const double length = proportions.limb_lengths[Index(bone.child)];
    glm::dvec3 limb = length * DirectionAtRest(bone.child);
    // Feet fall to the floor.
    if (bone.child == kLeftFoot || bone.child == kRightFoot) {
      const double drop = std::clamp(pose[bone.parent].y, 0.0, length);
      limb = {0, -drop, std::sqrt(length * length - drop * drop)};
    }
    pose[bone.child] = pose[bone.parent] + limb;
  }
  return pose;
}

TransitionRecord PlanThroughStanding(const MotionLibrary& library, const TransitionRequest& request,
                                     const MatchRules& rules) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const TweenRules& tween = library.in_betweens.tween;
  const BodyPose& leaving = library.motions[request.from].poses[request.request_frame];
  const BodyPose& entered = library.motions[request.to].poses.front();
  std::vector<BodyPose> own = SampleTween(Tween(leaving, StandingPose(library.proportions)), playing.rate_hz, tween);
  const int standing = static_cast<int>(own.size()) - 1;
  AppendTween(entered, playing.rate_hz, tween, own);

  TransitionRecord record;
  record.branch = Branch::kStandingPose;
  record.request_frame = request.request_frame;
  const int last = static_cast<int>(own.size()) - 1;
  record.segments = {{.clip = request.from, .first = request.request_frame, .last = request.request_frame, .own = {}},
                     {.clip = Segment::kOwnFrames, .first = 0, .last = last, .own = std::move(own)},
                     {.clip = request.to, .first = 0, .last = next.FrameCount() - 1, .own = {}}};
  // The tweens begin and end in the clips' own frames.
  const auto to_itself = [&](const Grades& grades) { return ComputeDistance(grades, grades, rules.weights); };
  record.distances = {to_itself(playing.grades[request.request_frame]), to_itself(next.grades.front())};
  record.wait_s = WaitOf(record.segments, playing.rate_hz);
  record.why = fmt::format("left at once: {:.2f} s into a standing pose and {:.2f} s into the first frame of {}",
                           standing / playing.rate_hz, (last - standing) / playing.rate_hz, library.names[request.to]);
  return record;
}

}  // namespace etude
