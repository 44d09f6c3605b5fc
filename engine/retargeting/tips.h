#pragma once

#include <array>
#include <vector>

#include "engine/motion/clip.h"
#include "engine/retargeting/anatomy.h"

namespace etude {

/// The positions of a skeleton's joints in several poses of a clip.
using MovingPoses = std::vector<std::vector<GlobalTransform>>;

/// Finds the missing hands, feet and head after all other roles are known. Each is the farthest descendant of wrist,
/// ankle or head at a plausible distance at rest; otherwise in the median of the poses in motion; otherwise a point
/// composed in the proportions of paper B's body. A thumb is never the tip of a hand. Among equally far tips (within
/// 10⁻⁴) the middle finger is taken, then index, ring and little finger, then the skeleton's first, so that both sides
/// agree. A head joint that was found by name plays the head only until the head's tip is found; this tip is then fixed
/// to the head joint. A point is composed from the rest pose. But if the head (or hand) points elsewhere in motion, by
/// over 60° (100°) in the median, the rest pose is not a human pose, and the point is composed from the mean of the
/// motion.
void FindTips(JointMapDraft& draft, const std::array<bool, kRoleCount>& is_taught, const MovingPoses& moving = {});

}  // namespace etude
