#include "engine/transitions/joins/splice.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "engine/motion/body.h"
#include "engine/transitions/joins/placing.h"

namespace etude {
namespace {

std::span<const BodyPose> FramesOf(const Segment& segment, std::span<const BodyMotion> clips) {
  return segment.clip == Segment::kOwnFrames ? std::span(segment.own) : std::span(clips[segment.clip].poses);
}

/// A segment and the floor move that aligns it with the spliced motion.
struct PlacedSegment {
  std::span<const BodyPose> frames;
  int first = 0;
  bool is_own = false;  // true if the choice made these frames itself
  FloorMove floor_move;
  Blend blend;

  BodyPose At(int frame) const { return floor_move.Apply(frames[frame]); }
  BodyPose Shown(int frame) const { return blend(At(frame), frame - first); }
  /// Returns the frame before `frame`. Before a clip's first frame the velocity is assumed to be constant.
  BodyPose Before(int frame) const {
    if (frame > 0) return At(frame - 1);
    return frames.size() > 1 ? FrameBefore(At(0), At(1)) : At(0);
  }
  /// Returns at most `count` frames that would be shown after `frame` if the old motion continued.
  std::vector<BodyPose> After(int frame, std::size_t count) const {
    std::vector<BodyPose> next;
    for (std::size_t f = frame + 1; f < frames.size() && next.size() < count; ++f) {
      next.push_back(Shown(static_cast<int>(f)));
    }
    return next;
  }
  /// Returns at most `count` frames after `frame`, without the join.
  std::vector<BodyPose> Own(int frame, std::size_t count) const {
    std::vector<BodyPose> next;
    for (std::size_t f = frame + 1; f < frames.size() && next.size() < count; ++f) {
      next.push_back(At(static_cast<int>(f)));
    }
    return next;
  }
};

/// Moves the segment `next`, which follows frame `left` of `old`, to where the body's momentum carries it in a join of
/// `frames` frames. If the old clip has ended, its last velocity is used; if the new clip ends within the join, its
/// velocity there is 0.
void Carry(const PlacedSegment& old, int left, int frames, PlacedSegment& next) {
  if (frames == 0) return;
  const int last = static_cast<int>(next.frames.size()) - 1, end = std::min(next.first + frames, last);
  const bool goes_on = left + 1 < static_cast<int>(old.frames.size()), moves = next.first + frames <= last;
  const PosePair leaving =
      goes_on ? PosePair{old.At(left), old.At(left + 1)} : PosePair{old.Before(left), old.At(left)};
  const PosePair arriving{next.At(moves ? end - 1 : end), next.At(end)};
  const glm::dvec3 shift = CarriedShift(leaving, old.At(left), arriving, frames);
  next.floor_move.x += shift.x;
  next.floor_move.z += shift.z;
}

/// Returns the floor move for the segment `next`, which follows frame `left` of `old`. If the choice made the frames of
/// `next` itself (is_own), the move aligns only the first of these frames.
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
  // Show the first segment from its clip's start.
  Splice splice;
  const BodyMotion& start = clips[segments.front().clip];
  const double rate_hz = splice.motion.rate_hz = start.rate_hz;
  std::vector<BodyPose>& shown = splice.motion.poses;
  shown.assign(start.poses.begin(), start.poses.begin() + segments.front().last + 1);

  // Append the other segments, each aligned with the segment before it.
  const Blend as_it_is = [](const BodyPose& target, int /*frames*/) { return target; };
  PlacedSegment old{.frames = FramesOf(segments.front(), clips), .floor_move = {}, .blend = as_it_is};
  for (std::size_t i = 1; i < segments.size(); ++i) {
    const int left = segments[i - 1].last, entered = segments[i].first;
    assert(entered < segments[i].last);
    const std::span<const BodyPose> frames = FramesOf(segments[i], clips);
    PlacedSegment next{.frames = frames,
                       .first = entered,
                       .is_own = segments[i].clip == Segment::kOwnFrames,
                       .floor_move = {},
                       .blend = {}};
    if (!segments[i].in_place) next.floor_move = Lay(join, old, left, next, rate_hz);
    const auto& preferred = segments[i].preferred;
    if (join.align != nullptr && preferred && preferred->carried) {
      Carry(old, left, static_cast<int>(std::lround(preferred->blend_s * rate_hz)), next);
    }
    // Measure the jump at the point between the unjoined clips, not in the joined motion: the jump then depends only on
    // the choice of frames.
    const PlacedPoint point{.frame = static_cast<int>(shown.size()) - 1,
                            .leaving_before = old.Before(left),
                            .leaving = old.At(left),
                            .arriving = next.At(entered),
                            .arriving_after = next.At(entered + 1)};

    // Begin the join, and pass the segment's frames through it.
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
    // Keep the clip's own frames of every segment between the first and the last; the measures use them.
    if (i + 1 < segments.size()) {
      std::vector<BodyPose>& between = splice.between.emplace_back();
      if (!next.is_own) between = next.Own(entered - 1, frames.size());
    }
    old = std::move(next);
  }
  // Keep the clip's own frames of the last segment; the measures use them.
  for (int frame = segments.back().first; frame <= segments.back().last; ++frame)
    splice.wanted.push_back(old.At(frame));
  return splice;
}

}  // namespace etude
