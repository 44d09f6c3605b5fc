#include "engine/motion/tree_motion.h"

#include <algorithm>
#include <cmath>

namespace etude {

Result<TreeMotion> TreeMotionOf(const RawMotion& motion) {
  const std::size_t joints = motion.joints.size();
  if (motion.rotations.empty())
    return Fail({motion.name}, "the motion has only points; allowed: motions with joint rotations");
  if (std::ranges::count(motion.parents, -1) != 1 || motion.parents.front() != -1) {
    return Fail({motion.name}, "the motion has {} roots; allowed: one root, the first joint",
                std::ranges::count(motion.parents, -1));
  }
  if (!std::ranges::all_of(motion.positions, IsSeen))
    return Fail({motion.name},
                "in some frames, the position of a joint is missing; allowed: every joint in every frame");
  TreeMotion made{
      {motion.joints, motion.parents, std::vector<glm::dvec3>(joints), std::vector<bool>(joints)}, motion.rate_hz, {}};
  for (const int joint : motion.added) made.tree.is_point[static_cast<std::size_t>(joint)] = true;
  made.poses.resize(motion.FrameCount());
  for (std::size_t f = 0; f < made.poses.size(); ++f) {
    TreePose& pose = made.poses[f];
    pose.root = motion.At(f, 0);
    const glm::dquat* globals = &motion.rotations[f * joints];
    for (std::size_t j = 0; j < joints; ++j) {
      const int parent = motion.parents[j];
      glm::dquat turn = parent < 0 ? globals[j] : glm::conjugate(globals[parent]) * globals[j];
      if (f > 0 && glm::dot(turn, made.poses[f - 1].turns[j]) < 0) turn = -turn;
      pose.turns.push_back(turn);
      if (f > 0 || parent < 0) continue;
      made.tree.offsets[j] = glm::conjugate(globals[parent]) * (motion.At(0, j) - motion.At(0, parent));
    }
  }
  return made;
}

void AppendGlobals(const JointTree& tree, const TreePose& pose, std::vector<glm::dvec3>& positions,
                   std::vector<glm::dquat>& turns) {
  const std::size_t first = positions.size();
  for (std::size_t j = 0; j < tree.size(); ++j) {
    if (tree.parents[j] < 0) {
      positions.push_back(pose.root);
      turns.push_back(pose.turns[j]);
      continue;
    }
    const std::size_t parent = first + static_cast<std::size_t>(tree.parents[j]);
    const glm::dvec3 position = positions[parent] + turns[parent] * tree.offsets[j];
    const glm::dquat turn = turns[parent] * pose.turns[j];
    positions.push_back(position);
    turns.push_back(turn);
  }
}

glm::dvec3 RotationVector(glm::dquat turn) {
  if (turn.w < 0) turn = -turn;
  const glm::dvec3 axis(turn.x, turn.y, turn.z);
  const double sine = glm::length(axis);
  constexpr double kSmall = 1e-9;  // if sin(angle / 2) is smaller, the angle is 2 sin(angle / 2) to all digits
  return sine < kSmall ? 2.0 * axis : axis * (2 * std::atan2(sine, turn.w) / sine);
}

glm::dquat TurnOf(const glm::dvec3& rotation_vector) {
  const double angle = glm::length(rotation_vector);
  constexpr double kSmall = 1e-9;
  const double share = angle < kSmall ? 0.5 : std::sin(angle / 2) / angle;
  return {std::cos(angle / 2), share * rotation_vector.x, share * rotation_vector.y, share * rotation_vector.z};
}

}  // namespace etude
