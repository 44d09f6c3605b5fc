#include "engine/bridging/splice.h"

#include <algorithm>
#include <cassert>

#include "engine/bridging/alignment.h"
#include "engine/bridging/inertialise.h"

namespace etude {
namespace {

/// The frame before the first one, as if the motion had begun at a steady speed.
BodyPose Extrapolate(const BodyPose& first, const BodyPose& second) {
  BodyPose before;
  for (std::size_t i = 0; i < kRoleCount; ++i) before.joints[i] = 2.0 * first.joints[i] - second.joints[i];
  return before;
}

}  // namespace

Splice SpliceClips(std::span<const BodyMotion> clips, std::span<const Switch> switches, Join join) {
  assert(!switches.empty());
  Splice splice;
  const BodyMotion& start = clips[switches.front().from_clip];
  const double rate_hz = splice.motion.rate_hz = start.rate_hz;
  std::vector<BodyPose>& shown = splice.motion.poses;
  shown.assign(start.poses.begin(), start.poses.begin() + switches.front().from_frame + 1);

  FloorMove place;  // of the clip that plays
  for (std::size_t i = 0; i < switches.size(); ++i) {
    const std::vector<BodyPose>& old = clips[switches[i].from_clip].poses;
    const std::vector<BodyPose>& next = clips[switches[i].to_clip].poses;
    const int left = switches[i].from_frame;
    const int entered = switches[i].to_frame;
    const int end = i + 1 < switches.size() ? switches[i + 1].from_frame + 1 : static_cast<int>(next.size());
    assert(entered + 1 < end);

    // The clips' own frames, not what a join made of them: a seam's gap belongs to the choice of frames.
    Seam seam;
    seam.frame = static_cast<int>(shown.size()) - 1;
    seam.leaving = place.Apply(old[left]);
    seam.leaving_before = place.Apply(old[std::max(left - 1, 0)]);
    place = AlignOnFloor(next[entered], seam.leaving);
    seam.arriving = place.Apply(next[entered]);
    seam.arriving_after = place.Apply(next[entered + 1]);

    const BodyPose arriving_before =
        entered > 0 ? place.Apply(next[entered - 1]) : Extrapolate(seam.arriving, seam.arriving_after);
    const PosePair shown_last{shown[std::max(seam.frame - 1, 0)], shown[seam.frame]};
    const Inertialiser offsets(shown_last, {arriving_before, seam.arriving}, rate_hz);
    for (int frame = entered + 1; frame < end; ++frame) {
      const BodyPose pose = place.Apply(next[frame]);
      shown.push_back(join == Join::kCut ? pose : offsets.Apply(pose, (frame - entered) / rate_hz));
    }
    splice.seams.push_back(seam);
  }
  return splice;
}

}  // namespace etude
