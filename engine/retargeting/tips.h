#pragma once

#include <array>
#include <vector>

#include "engine/motion/clip.h"
#include "engine/retargeting/anatomy.h"

namespace etude {

/// The positions of a skeleton's joints in several poses of a clip.
using MovingPoses = std::vector<std::vector<GlobalTransform>>;

/// Finds the missing hands, feet and head after all other roles are known. A tip is the farthest descendant of wrist,
/// ankle or head whose distance at rest is plausible. If no distance at rest is plausible, median distances in motion
/// are compared instead; for feet they are always compared, and a joint that is 20 % farther in motion is preferred.
/// If this finds no joint either, the tip is a point composed in the proportions of paper B's body. A thumb is never
/// the tip of a hand. Among equally far tips (within 10⁻⁴) the middle finger is taken, then index, ring and little
/// finger, then the skeleton's first, so that both sides agree. If a head joint was found by name, the head's tip
/// replaces it; a composed tip is fixed to it. A point is composed from the rest pose. But if the head (or hand)
/// points elsewhere in motion, by over 60° (100°) in the median, the rest pose counts as no human pose, and the point
/// is composed from the mean of the motion.
void FindTips(JointMapDraft& draft, const std::array<bool, kRoleCount>& is_taught, const MovingPoses& moving = {});

}  // namespace etude
