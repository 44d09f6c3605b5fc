#include "bench/tasks/base/ik_targets.h"

#include "engine/base/angles.h"
#include "engine/base/euler.h"

namespace etude {

std::vector<EffectorTarget> TargetsMetBy(const KinematicTree& tree, const TreeState& state) {
  std::vector<EffectorTarget> targets;
  for (const LimbFrame& effector : ComputeFrames(tree, state).effectors) {
    EffectorTarget& target = targets.emplace_back();
    target.position = effector.position;
    target.axes = effector.axes;
  }
  return targets;
}

void AddTo(Digest& digest, std::span<const EffectorTarget> targets) {
  for (const EffectorTarget& target : targets) {
    for (int i = 0; i < 3; ++i) digest.Add(target.position[i]);
    for (int i = 0; i < 9; ++i) digest.Add(target.axes[i / 3][i % 3]);
  }
}

void Disturb(std::vector<EffectorTarget>& targets, const TargetNoise& noise, RandomStream& dice) {
  for (EffectorTarget& target : targets) {
    const glm::dvec3 shift = 0.01 * noise.position_cm * dice.Normal3();
    const glm::dvec3 turn = Radians(noise.orientation_deg) * dice.Normal3();
    target.position += shift;
    const double angle = glm::length(turn);
    if (angle > 0) target.axes = AxisRotation(turn / angle, angle) * target.axes;
  }
}

}  // namespace etude
