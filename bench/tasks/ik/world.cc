#include "bench/tasks/ik/world.h"

#include <algorithm>
#include <cmath>

#include "bench/tasks/base/ik_targets.h"
#include "engine/base/angles.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

double LengthOf(const KinematicTree& tree, BodyTreeJoint upper_end) { return glm::length(tree.joints[upper_end].p_PJ); }

/// Bends each leg in its plane. The shanks lean forward by `shank`, the thighs backward by `thigh`, radians.
void BendLegs(const KinematicTree& tree, double shank, double thigh, std::vector<double>& angles) {
  constexpr int kZ = 2;
  const auto set = [&](BodyTreeJoint joint, int axis, double angle) {
    angles[static_cast<std::size_t>(tree.joints[joint].first_dof + axis)] = angle;
  };
  set(kTreeLeftAnkle, 0, -shank);
  set(kTreeLeftKnee, 0, shank + thigh);
  set(kTreeLeftHip, kZ, -thigh);
  set(kTreeRightHip, 0, thigh);
  set(kTreeRightKnee, 0, -(shank + thigh));
  set(kTreeRightAnkle, 0, shank);
}

/// Draws the true pose and the start pose.
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

/// Moves the target of one effector straight away from the root, until it is `beyond` metres farther than the border of
/// the effector's reach in that direction. Bisection finds the border.
void PullOutOfReach(const KinematicTree& tree, double beyond, RandomStream& dice, IkProblem& problem) {
  constexpr double kFarOut = 100;  // metres, beyond every reach
  constexpr int kHalvings = 50;    // number of bisections, for an accuracy of 10⁻¹³ m
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

TreeState StretchedLimbPose(const KinematicTree& tree, RandomStream& dice) {
  TreeState state = StandingState(tree);
  // Crouch by a random angle of the shanks. The thighs lean backward, so that the hips move down vertically.
  const double shank = LengthOf(tree, kTreeLeftKnee), thigh = LengthOf(tree, kTreeLeftHip);
  const double lean = Radians(dice.Uniform(8, 19));  // the ankle may turn by 20° under every set of limits
  const double counter = std::asin(shank * std::sin(lean) / thigh);
  BendLegs(tree, lean, counter, state.angles);
  const double drop = shank * (1 - std::cos(lean)) + thigh * (1 - std::cos(counter));

  // Shoulder, elbow and wrist form a triangle (law of cosines). The hand hangs vertically below the shoulder.
  const double upper = LengthOf(tree, kTreeLeftElbow), fore = LengthOf(tree, kTreeLeftWrist);
  const double span = upper + fore - 1.5 * drop;
  const double back = std::acos((upper * upper + span * span - fore * fore) / (2 * upper * span));
  const double forward = std::acos((fore * fore + span * span - upper * upper) / (2 * fore * span));
  for (const BodyTreeJoint shoulder : {kTreeLeftShoulder, kTreeRightShoulder}) {
    const auto first = [&](int offset) { return static_cast<std::size_t>(tree.joints[shoulder + offset].first_dof); };
    state.angles[first(0)] = -back;
    state.angles[first(1)] = back + forward;
    state.angles[first(2)] = -forward;
  }
  return state;
}

IkWorld MakeIkWorld(const KinematicTree& tree, const IkTrialOptions& options, const WorldKey& key) {
  IkWorld world;
  world.truth = StandingState(tree);
  world.problem.start = world.truth;
  world.problem.limits = tree.limits;
  // Make the true pose and the start pose.
  if (options.start == IkStart::kStretched) {
    RandomStream dice(key, "crouch");
    world.truth = StretchedLimbPose(tree, dice);
  } else {
    MakePoses(tree, options, key, world);
  }
  // Make the targets with noise. Move one target out of reach if the options require it.
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
