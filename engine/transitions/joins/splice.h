#pragma once

#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "engine/transitions/joins/join.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// A transition point in the frame of the spliced motion.
struct PlacedPoint {
  int frame = 0;                      ///< index in the spliced motion: the last frame of the old segment
  BodyPose leaving_before, leaving;   ///< the old segment's frame before the point, and its frame at the point
  BodyPose arriving, arriving_after;  ///< the new segment's frame at the point, and its frame after it
};

/// A motion composed of clips.
struct Splice {
  BodyMotion motion;
  std::vector<PlacedPoint> points;  ///< in order
  /// The last segment's frames as they are in its clip: aligned, but not changed by the join. The first entry belongs
  /// to the frame of the last transition point.
  std::vector<BodyPose> wanted;
  /// For each segment between the first and the last: the frames as they are in its clip, aligned, but not changed by
  /// the join, from the segment's first transition point on; an empty list if a choice made the segment's frames.
  std::vector<std::vector<BodyPose>> between;
};

/// Returns the frame before `first` by linear extrapolation from `first` and `second`.
BodyPose FrameBefore(const BodyPose& first, const BodyPose& second);

/// Plays the first segment's clip from its start (not from the request) to the segment's end, then the other segments
/// to the end of the last segment. Every segment is rotated and moved on the floor (yaw, x, z) to continue where the
/// previous segment ended, unless it is already in place (Segment::in_place). There must be at least two segments, each
/// with at least one frame to play. `join_settings` are the values for JoinKind::begin.
Splice SpliceSegments(std::span<const BodyMotion> clips, std::span<const Segment> segments, const JoinKind& join,
                      std::span<const double> join_settings = {});

}  // namespace etude
