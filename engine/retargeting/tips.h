#pragma once

#include <array>
#include <vector>

#include "engine/motion/clip.h"
#include "engine/retargeting/anatomy.h"

namespace etude {

/// Several poses of a skeleton in motion: its joints in each.
using MovingPoses = std::vector<std::vector<GlobalTransform>>;

/// Finds hands, feet and head that are not given, after all other roles are known: the farthest descendant of wrist,
/// ankle and head at a plausible distance at rest, or else in the median of the poses in motion; or else a point composed
/// in the proportions of paper B's body. A thumb is never the tip of a hand. Among equally far tips (within 10⁻⁴) the
/// middle finger is taken, then index, ring and little finger, then the skeleton's first, so that both sides agree. A
/// head joint that was found by name is first assigned to the head; it then becomes the joint that carries the tip. A
/// point is composed at rest, unless it points elsewhere in motion (by over 45° in the median): then the rest pose is
/// none, and the point is where the motion has it in the mean.
void FindTips(JointMapDraft& draft, const std::array<bool, kRoleCount>& is_taught, const MovingPoses& moving = {});

}  // namespace etude
