#pragma once

#include <span>
#include <vector>

#include "engine/bridging/transition.h"
#include "engine/motion/body.h"

namespace etude {

/// How two clips are put together at a switch.
enum class Join {
  kCut,           ///< paper A's: the next frame shown is the new clip's
  kInertialised,  ///< see Inertialiser
};

/// One place where a motion changes clips: what met there, aligned on the floor.
struct Seam {
  int frame = 0;                      ///< of the spliced motion: the last frame of the old clip
  BodyPose leaving_before, leaving;   ///< the old clip's frame before the switch, and at it
  BodyPose arriving, arriving_after;  ///< the new clip's frame at the switch, and after it
};

/// A motion put together from clips.
struct Splice {
  BodyMotion motion;
  std::vector<Seam> seams;  ///< in order, one per switch
};

/// Plays the first clip from its start to the first switch, and so on to the last clip's end. Every
/// clip is turned and moved on the floor (yaw, x, z) to continue where the one before it stood.
/// `switches` must not be empty, and each must leave a frame to play.
Splice SpliceClips(std::span<const BodyMotion> clips, std::span<const Switch> switches, Join join);

}  // namespace etude
