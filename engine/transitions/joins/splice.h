#pragma once

#include <span>
#include <vector>

#include "engine/motion/body.h"
#include "engine/transitions/base/transition_record.h"
#include "engine/transitions/joins/join.h"

namespace etude {

/// One place where a motion changes clips: what met there, aligned on the floor.
struct Seam {
  int frame = 0;                      ///< of the spliced motion: the last frame of the old leg
  BodyPose leaving_before, leaving;   ///< the old leg's frame before the switch, and at it
  BodyPose arriving, arriving_after;  ///< the new leg's frame at the switch, and after it
};

/// A motion put together from clips.
struct Splice {
  BodyMotion motion;
  std::vector<Seam> seams;  ///< in order, one per switch
};

/// The frame before the first one, as if a motion had begun at a steady speed.
BodyPose FrameBefore(const BodyPose& first, const BodyPose& second);

/// Plays the first leg's clip from its start (not from the request) to the leg's end, and so on to the last leg's end.
/// Every leg is turned and moved on the floor (yaw, x, z) to continue where the one before it stood, unless it is in
/// place. There must be two legs at least, and each must have a frame to play.
Splice SpliceLegs(std::span<const BodyMotion> clips, std::span<const Leg> legs, const Join& join,
                  const JoinSettings& settings = {});

}  // namespace etude
