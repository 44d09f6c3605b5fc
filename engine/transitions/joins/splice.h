#pragma once

#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "engine/transitions/joins/join.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// A transition point in the place where it is shown.
struct PlacedPoint {
  int frame = 0;                      ///< of the spliced motion: the last frame of the old segment
  BodyPose leaving_before, leaving;   ///< the old segment's frame before the point, and at it
  BodyPose arriving, arriving_after;  ///< the new segment's frame at the point, and after it
};

/// A motion put together from clips.
struct Splice {
  BodyMotion motion;
  std::vector<PlacedPoint> points;  ///< in order
  /// The last segment's own frames from the one entered on, in the place where they are shown, without the join: the
  /// first stands where the last point's frame does.
  std::vector<BodyPose> wanted;
  /// The poses of each clip on the way, of which the first frame likewise stands where the frame of its own point does;
  /// empty where a choice made the frames itself.
  std::vector<std::vector<BodyPose>> between;
};

/// The frame before the first one, as if a motion had begun at a steady speed.
BodyPose FrameBefore(const BodyPose& first, const BodyPose& second);

/// Plays the first segment's clip from its start (not from the request) to the segment's end, and so on to the end of
/// the last. Every segment is turned and moved on the floor (yaw, x, z) to continue where the one before it stood,
/// unless it is in place. There must be two at least, and each must have a frame to play. `join_settings`: as
/// Join::begin takes them.
Splice SpliceSegments(std::span<const BodyMotion> clips, std::span<const Segment> segments, const JoinKind& join,
                      std::span<const double> join_settings = {});

}  // namespace etude
