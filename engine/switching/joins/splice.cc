#include "engine/switching/joins/splice.h"

#include <algorithm>
#include <cassert>

#include "engine/bridging/alignment.h"

namespace etude {
namespace {

/// The frame before the first one, as if the motion had begun at a steady speed.
BodyPose Extrapolate(const BodyPose& first, const BodyPose& second) {
  BodyPose before;
  for (std::size_t i = 0; i < kRoleCount; ++i) before.joints[i] = 2.0 * first.joints[i] - second.joints[i];
  return before;
}

std::span<const BodyPose> FramesOf(const Leg& leg, std::span<const BodyMotion> clips) {
  return leg.clip == Leg::kOwnFrames ? std::span(leg.own) : std::span(clips[leg.clip].poses);
}

/// What the old motion would have shown after `frame`.
std::vector<BodyPose> Continuation(std::span<const BodyPose> old, int frame, const FloorMove& place,
                                   std::size_t count) {
  std::vector<BodyPose> next;
  for (const BodyPose& pose : old.subspan(frame + 1)) {
    if (next.size() == count) break;
    next.push_back(place.Apply(pose));
  }
  return next;
}

}  // namespace

Splice SpliceLegs(std::span<const BodyMotion> clips, std::span<const Leg> legs, const Join& join,
                  const JoinSettings& settings) {
  assert(legs.size() >= 2);
  Splice splice;
  const BodyMotion& start = clips[legs.front().clip];
  const double rate_hz = splice.motion.rate_hz = start.rate_hz;
  std::vector<BodyPose>& shown = splice.motion.poses;
  shown.assign(start.poses.begin(), start.poses.begin() + legs.front().last + 1);

  FloorMove place;  // of the leg that plays
  for (std::size_t i = 1; i < legs.size(); ++i) {
    const std::span<const BodyPose> old = FramesOf(legs[i - 1], clips), next = FramesOf(legs[i], clips);
    const int left = legs[i - 1].last, entered = legs[i].first;
    assert(entered < legs[i].last);

    // The clips' own frames, not what a join made of them: a seam's gap belongs to the choice of frames.
    Seam seam;
    seam.frame = static_cast<int>(shown.size()) - 1;
    seam.leaving = place.Apply(old[left]);
    seam.leaving_before = place.Apply(old[std::max(left - 1, 0)]);
    const auto blended = static_cast<std::size_t>(settings.blend_s * rate_hz) + 1;
    const std::vector<BodyPose> continuation = Continuation(old, left, place, blended);
    place = legs[i].in_place ? FloorMove{} : AlignOnFloor(next[entered], seam.leaving);
    seam.arriving = place.Apply(next[entered]);
    seam.arriving_after = place.Apply(next[entered + 1]);

    const BodyPose arriving_before =
        entered > 0 ? place.Apply(next[entered - 1]) : Extrapolate(seam.arriving, seam.arriving_after);
    const Meeting meeting{.shown = {shown[std::max(seam.frame - 1, 0)], shown[seam.frame]},
                          .target = {arriving_before, seam.arriving},
                          .continuation = continuation,
                          .rate_hz = rate_hz};
    const Blend blend = join.begin(meeting, settings);
    for (int frame = entered + 1; frame <= legs[i].last; ++frame) {
      shown.push_back(blend(place.Apply(next[frame]), frame - entered));
    }
    splice.seams.push_back(seam);
  }
  return splice;
}

}  // namespace etude
