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
/// finger, then the skeleton's first, so that both sides agree. If a head joint was found by name, the tip of the
/// head plays its role; a composed tip is fixed to that joint. A tip is composed from the rest pose. If, however, the
/// head points in another direction in motion than at rest (by over 60° in the median; a hand: by over 100°), the
/// rest pose does not count as a human pose, and the tip is composed from the mean of the motion.
void FindTips(JointMapDraft& draft, const std::array<bool, kRoleCount>& is_taught, const MovingPoses& moving = {});

}  // namespace etude
