#include "engine/transitions/joins/splice.h"

#include <cassert>
#include <utility>

#include "engine/transitions/base/alignment.h"

namespace etude {
namespace {

std::span<const BodyPose> FramesOf(const Leg& leg, std::span<const BodyMotion> clips) {
  return leg.clip == Leg::kOwnFrames ? std::span(leg.own) : std::span(clips[leg.clip].poses);
}

/// A leg in the place where it is shown.
struct PlacedLeg {
  std::span<const BodyPose> frames;
  int first = 0;
  FloorMove place;
  Blend blend;

  BodyPose At(int frame) const { return place.Apply(frames[frame]); }
  BodyPose Shown(int frame) const { return blend(At(frame), frame - first); }
  /// The frame before `frame`; a clip is taken to have begun at a steady speed.
  BodyPose Before(int frame) const {
    if (frame > 0) return At(frame - 1);
    return frames.size() > 1 ? FrameBefore(At(0), At(1)) : At(0);
  }
  /// What would be shown after `frame`, if there was no switch: at most `count` frames.
  std::vector<BodyPose> After(int frame, std::size_t count) const {
    std::vector<BodyPose> next;
    for (std::size_t f = frame + 1; f < frames.size() && next.size() < count; ++f) {
      next.push_back(Shown(static_cast<int>(f)));
    }
    return next;
  }
};

}  // namespace

BodyPose FrameBefore(const BodyPose& first, const BodyPose& second) {
  BodyPose before;
  for (std::size_t i = 0; i < kRoleCount; ++i) before.joints[i] = 2.0 * first.joints[i] - second.joints[i];
  return before;
}

Splice SpliceLegs(std::span<const BodyMotion> clips, std::span<const Leg> legs, const Join& join,
                  const JoinSettings& settings) {
  assert(legs.size() >= 2);
  Splice splice;
  const BodyMotion& start = clips[legs.front().clip];
  const double rate_hz = splice.motion.rate_hz = start.rate_hz;
  std::vector<BodyPose>& shown = splice.motion.poses;
  shown.assign(start.poses.begin(), start.poses.begin() + legs.front().last + 1);
  const auto most_blended = static_cast<std::size_t>(settings.blend_s * rate_hz) + 1;

  const Blend as_it_is = [](const BodyPose& target, int /*frames*/) { return target; };
  PlacedLeg old{.frames = FramesOf(legs.front(), clips), .place = {}, .blend = as_it_is};
  for (std::size_t i = 1; i < legs.size(); ++i) {
    const int left = legs[i - 1].last, entered = legs[i].first;
    assert(entered < legs[i].last);
    const std::span<const BodyPose> frames = FramesOf(legs[i], clips);
    PlacedLeg next{.frames = frames, .first = entered, .place = {}, .blend = {}};
    if (!legs[i].in_place) next.place = AlignOnFloor(frames[entered], old.At(left));
    // The clips' own frames, not what a join made of them: a seam's gap belongs to the choice of frames.
    const Seam seam{.frame = static_cast<int>(shown.size()) - 1,
                    .leaving_before = old.Before(left),
                    .leaving = old.At(left),
                    .arriving = next.At(entered),
                    .arriving_after = next.At(entered + 1)};

    const std::vector<BodyPose> continuation = old.After(left, most_blended);
    const SeamMotions motions{
        .shown = {seam.frame > 0 ? shown[seam.frame - 1] : seam.leaving_before, shown[seam.frame]},
        .target = {next.Before(entered), seam.arriving},
        .continuation = continuation,
        .rate_hz = rate_hz};
    next.blend = join.begin(motions, settings);
    for (int frame = entered + 1; frame <= legs[i].last; ++frame) shown.push_back(next.Shown(frame));
    splice.seams.push_back(seam);
    old = std::move(next);
  }
  return splice;
}

}  // namespace etude
