#include "engine/transitions/joins/splice.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "engine/motion/body.h"

namespace etude {
namespace {

std::span<const BodyPose> FramesOf(const Segment& segment, std::span<const BodyMotion> clips) {
  return segment.clip == Segment::kOwnFrames ? std::span(segment.own) : std::span(clips[segment.clip].poses);
}

/// A segment in the place where it is shown.
struct PlacedSegment {
  std::span<const BodyPose> frames;
  int first = 0;
  bool is_own = false;  // made by the choice
  FloorMove place;
  Blend blend;

  BodyPose At(int frame) const { return place.Apply(frames[frame]); }
  BodyPose Shown(int frame) const { return blend(At(frame), frame - first); }
  /// The frame before `frame`; a clip is taken to have begun at a steady speed.
  BodyPose Before(int frame) const {
    if (frame > 0) return At(frame - 1);
    return frames.size() > 1 ? FrameBefore(At(0), At(1)) : At(0);
  }
  /// Returns at most `count` frames that would be shown after `frame` if the old motion went on.
  std::vector<BodyPose> After(int frame, std::size_t count) const {
    std::vector<BodyPose> next;
    for (std::size_t f = frame + 1; f < frames.size() && next.size() < count; ++f) {
      next.push_back(Shown(static_cast<int>(f)));
    }
    return next;
  }
  /// The motion's own frames after `frame`, at most `count`.
  std::vector<BodyPose> Own(int frame, std::size_t count) const {
    std::vector<BodyPose> next;
    for (std::size_t f = frame + 1; f < frames.size() && next.size() < count; ++f) {
      next.push_back(At(static_cast<int>(f)));
    }
    return next;
  }
};

/// Returns where a segment is laid that follows `old` at its frame `left`. Frames that a choice made itself begin
/// there.
FloorMove Lay(const JoinKind& join, const PlacedSegment& old, int left, const PlacedSegment& next, double rate_hz) {
  if (join.align == nullptr || next.is_own) return AlignOnFloor(next.frames[next.first], old.At(left));
  const std::size_t count = static_cast<std::size_t>(rate_hz * kAlignedSeconds);
  std::vector<BodyPose> going = old.Own(left, count);
  going.insert(going.begin(), old.At(left));
  return join.align(going, next.frames.subspan(next.first).first(std::min(count + 1, next.frames.size() - next.first)),
                    rate_hz);
}

}  // namespace

BodyPose FrameBefore(const BodyPose& first, const BodyPose& second) {
  BodyPose before;
  for (std::size_t i = 0; i < kRoleCount; ++i) before.joints[i] = 2.0 * first.joints[i] - second.joints[i];
  return before;
}

Splice SpliceSegments(std::span<const BodyMotion> clips, std::span<const Segment> segments, const JoinKind& join,
                      std::span<const double> join_settings) {
  assert(segments.size() >= 2);
  Splice splice;
  const BodyMotion& start = clips[segments.front().clip];
  const double rate_hz = splice.motion.rate_hz = start.rate_hz;
  std::vector<BodyPose>& shown = splice.motion.poses;
  shown.assign(start.poses.begin(), start.poses.begin() + segments.front().last + 1);

  const Blend as_it_is = [](const BodyPose& target, int /*frames*/) { return target; };
  PlacedSegment old{.frames = FramesOf(segments.front(), clips), .place = {}, .blend = as_it_is};
  for (std::size_t i = 1; i < segments.size(); ++i) {
    const int left = segments[i - 1].last, entered = segments[i].first;
    assert(entered < segments[i].last);
    const std::span<const BodyPose> frames = FramesOf(segments[i], clips);
    PlacedSegment next{.frames = frames,
                       .first = entered,
                       .is_own = segments[i].clip == Segment::kOwnFrames,
                       .place = {},
                       .blend = {}};
    if (!segments[i].in_place) next.place = Lay(join, old, left, next, rate_hz);
    // Of the clips themselves, not of the joined motion: the gap at the point measures the choice of frames alone.
    const PlacedPoint point{.frame = static_cast<int>(shown.size()) - 1,
                            .leaving_before = old.Before(left),
                            .leaving = old.At(left),
                            .arriving = next.At(entered),
                            .arriving_after = next.At(entered + 1)};

    const JoinInput input{
        .shown = {point.frame > 0 ? shown[point.frame - 1] : point.leaving_before, shown[point.frame]},
        .target = {next.Before(entered), point.arriving},
        .continuation = [&](std::size_t count) { return old.After(left, count); },
        .upcoming = [&](std::size_t count) { return next.Own(entered, count); },
        .preferred = segments[i].preferred,
        .rate_hz = rate_hz};
    next.blend = join.begin(input, join_settings);
    for (int frame = entered + 1; frame <= segments[i].last; ++frame) shown.push_back(next.Shown(frame));
    splice.points.push_back(point);
    if (i + 1 < segments.size()) {
      std::vector<BodyPose>& between = splice.between.emplace_back();
      if (!next.is_own) between = next.Own(entered - 1, frames.size());
    }
    old = std::move(next);
  }
  for (int frame = segments.back().first; frame <= segments.back().last; ++frame)
    splice.wanted.push_back(old.At(frame));
  return splice;
}

}  // namespace etude
