#include "bench/tasks/ik/ik_world.h"

#include <algorithm>

#include "engine/base/angles.h"

namespace etude {

IkWorld MakeIkWorld(const KinematicTree& tree, const IkTrialOptions& options, const WorldKey& key) {
  RandomStream pose(key, "pose");
  RandomStream noise(key, "joint-noise");
  const double strength = Radians(options.joint_noise_deg);
  IkWorld world;
  world.truth = StandingState(tree);
  world.problem.start = world.truth;
  world.problem.limits = tree.limits;
  for (std::size_t i = 0; i < tree.limits.size(); ++i) {
    const AngleRange& range = tree.limits[i];
    const double middle = 0.5 * (range.lower + range.upper), half = 0.5 * (range.upper - range.lower);
    const double true_angle = middle + options.pose_range * half * pose.Uniform(-1, 1);
    const double disturbance = options.noise == NoiseKind::kGaussian ? noise.Normal() : noise.Uniform(-1, 1);
    world.truth.angles[i] = true_angle;
    world.problem.start.angles[i] = std::clamp(true_angle + strength * disturbance, range.lower, range.upper);
  }
  for (const LimbFrame& effector : ComputeFrames(tree, world.truth).effectors) {
    EffectorTarget target;
    target.position = effector.position;
    target.axes = effector.axes;
    world.problem.targets.push_back(target);
  }
  return world;
}

}  // namespace etude
