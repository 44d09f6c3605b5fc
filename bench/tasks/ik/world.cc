#include "bench/tasks/ik/world.h"

#include <algorithm>

#include "bench/tasks/base/ik_targets.h"
#include "bench/tasks/ik/stretched.h"
#include "engine/base/angles.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

/// A true pose, and where a solver begins.
void MakePoses(const KinematicTree& tree, const IkTrialOptions& options, const WorldKey& key, IkWorld& world) {
  RandomStream pose(key, "pose");
  RandomStream noise(key, "joint-noise");
  const double strength = Radians(options.joint_noise_deg);
  for (std::size_t i = 0; i < tree.limits.size(); ++i) {
    const AngleRange& range = tree.limits[i];
    const double middle = 0.5 * (range.lower + range.upper), half = 0.5 * (range.upper - range.lower);
    const double true_angle = middle + options.pose_range * half * pose.Uniform(-1, 1);
    const double disturbance = options.noise == NoiseKind::kGaussian ? noise.Normal() : noise.Uniform(-1, 1);
    world.truth.angles[i] = true_angle;
    world.problem.start.angles[i] = options.start == IkStart::kMiddle
                                        ? middle
                                        : std::clamp(true_angle + strength * disturbance, range.lower, range.upper);
  }
}

/// Pulls the target of one effector straight away from the root: `beyond` metres farther than the nearest place there
/// that limbs are too short for.
void PullOutOfReach(const KinematicTree& tree, double beyond, RandomStream& dice, IkProblem& problem) {
  constexpr double kFarOut = 100;  // metres
  constexpr int kHalvings = 50;    // to 10⁻¹³ m
  EffectorTarget& target = problem.targets[dice.IndexBelow(problem.targets.size())];
  const glm::dvec3 from = target.position, outward = glm::normalize(from - problem.start.root_position);
  double within = 0, without = kFarOut;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (within + without);
    target.position = from + middle * outward;
    (IsOutOfReach(tree, problem) ? without : within) = middle;
  }
  target.position = from + (without + beyond) * outward;
}

}  // namespace

IkWorld MakeIkWorld(const KinematicTree& tree, const IkTrialOptions& options, const WorldKey& key) {
  IkWorld world;
  world.truth = StandingState(tree);
  world.problem.start = world.truth;
  world.problem.limits = tree.limits;
  if (options.start == IkStart::kStretched) {
    RandomStream dice(key, "crouch");
    world.truth = CrouchBeneathStandingHands(tree, dice);
  } else {
    MakePoses(tree, options, key, world);
  }
  world.problem.targets = TargetsMetBy(tree, world.truth);
  for (EffectorTarget& target : world.problem.targets) {
    if (!options.asks_positions) target.position_weight = 0;
    if (!options.asks_axes) target.axis_weights = glm::dvec3(0);
  }
  RandomStream target_noise(key, "target-noise");
  Disturb(world.problem.targets, options.target_noise, target_noise);
  if (options.unreachable_cm > 0) {
    RandomStream dice(key, "unreachable");
    PullOutOfReach(tree, 0.01 * options.unreachable_cm, dice, world.problem);
  }
  return world;
}

std::string DigestOf(const IkWorld& world) {
  Digest digest;
  digest.Add(world.truth.angles).Add(world.problem.start.angles);
  AddTo(digest, world.problem.targets);
  return digest.Hex();
}

}  // namespace etude
