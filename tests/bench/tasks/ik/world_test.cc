#include "bench/tasks/ik/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/linear_targets.h"

namespace etude {
namespace {

WorldKey Trial(int trial) { return {.suite_seed = 1, .scenario = "worlds", .trial = trial}; }

KinematicTree TreeWith(LimitSet set) {
  KinematicTree tree = MakeBodyTree({});
  tree.limits = JointLimits(set);
  return tree;
}

double LongestError(const KinematicTree& tree, const TreeState& state, const IkProblem& problem) {
  const TreeFrames frames = ComputeFrames(tree, state);
  double longest = 0;
  for (std::size_t e = 0; e < problem.targets.size(); ++e) {
    const EffectorError error = ErrorOf(frames.effectors[e], problem.targets[e]);
    longest = std::max({longest, error.position, error.MeanAxisAngle(glm::dvec3(1))});
  }
  return longest;
}

TEST(IkWorld, ASweepChangesStrengthsAndNotTheDice) {
  const KinematicTree tree = MakeBodyTree({});
  const auto world = [&](double noise_deg, double range) {
    return MakeIkWorld(tree, {.pose_range = range, .joint_noise_deg = noise_deg}, Trial(0));
  };
  const IkWorld weak = world(1, 0.5), strong = world(4, 0.5), wide = world(1, 1.0);
  EXPECT_EQ(weak.truth.angles, strong.truth.angles);
  int unclipped = 0;
  for (std::size_t i = 0; i < tree.limits.size(); ++i) {
    const double middle = 0.5 * (tree.limits[i].lower + tree.limits[i].upper);
    EXPECT_NEAR(wide.truth.angles[i] - middle, 2 * (weak.truth.angles[i] - middle), 1e-12);
    const double start = strong.problem.start.angles[i];
    if (start == tree.limits[i].lower || start == tree.limits[i].upper) continue;
    EXPECT_NEAR(start - strong.truth.angles[i], 4 * (weak.problem.start.angles[i] - weak.truth.angles[i]), 1e-12);
    ++unclipped;
  }
  EXPECT_GT(unclipped, 20);
}

TEST(IkWorld, TargetsAreWhatTheTrueAnglesGive) {
  const KinematicTree tree = MakeBodyTree({});
  const IkWorld world = MakeIkWorld(tree, {}, Trial(0));
  const TreeFrames frames = ComputeFrames(tree, world.truth);
  for (std::size_t e = 0; e < 4; ++e) EXPECT_EQ(world.problem.targets[e].position, frames.effectors[e].position);
}

// Table 5.1(a): uniform noise of ±25° puts the ends 29–67 cm off and their axes 10–55°.
TEST(IkWorld, UniformNoiseOf25DegreesDisturbsAsMuchAsPaperBsTable) {
  const KinematicTree tree = MakeBodyTree({});
  IkTrialOptions options{.noise = NoiseKind::kUniform};
  options.joint_noise_deg = 25;
  double position = 0, axis = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    const IkWorld world = MakeIkWorld(tree, options, Trial(trial));
    const TreeFrames start = ComputeFrames(tree, world.problem.start);
    for (std::size_t e = 0; e < 4; ++e) {
      const EffectorError error = ErrorOf(start.effectors[e], world.problem.targets[e]);
      position += error.position / (4 * kTrials);
      axis += error.MeanAxisAngle(glm::dvec3(1)) / (4 * kTrials);
    }
  }
  EXPECT_GT(position, 0.29);
  EXPECT_LT(position, 0.67);
  EXPECT_GT(axis, Radians(10));
  EXPECT_LT(axis, Radians(55));
}

TEST(IkWorld, KeepsTruthAndStartWithinEverySetOfLimits) {
  for (const std::string& name : LimitSetNames()) {
    const KinematicTree tree = TreeWith(*FindLimitSet(name));
    const IkWorld world = MakeIkWorld(tree, {.pose_range = 1, .joint_noise_deg = 40}, Trial(3));
    for (std::size_t i = 0; i < tree.limits.size(); ++i) {
      EXPECT_EQ(world.problem.limits[i].lower, tree.limits[i].lower) << name;
      for (const double angle : {world.truth.angles[i], world.problem.start.angles[i]}) {
        EXPECT_GE(angle, tree.limits[i].lower - 1e-12) << name << i;
        EXPECT_LE(angle, tree.limits[i].upper + 1e-12) << name << i;
      }
    }
  }
}

TEST(IkWorld, AColdStartIsTheMiddleOfEveryRange) {
  const KinematicTree tree = MakeBodyTree({});
  IkTrialOptions options;
  const IkWorld disturbed = MakeIkWorld(tree, options, Trial(0));
  options.start = IkStart::kMiddle;
  const IkWorld cold = MakeIkWorld(tree, options, Trial(0));
  EXPECT_EQ(cold.truth.angles, disturbed.truth.angles) << "only the start differs";
  EXPECT_NE(cold.problem.start.angles, disturbed.problem.start.angles);
  for (std::size_t i = 0; i < tree.limits.size(); ++i) {
    EXPECT_DOUBLE_EQ(2 * cold.problem.start.angles[i], tree.limits[i].lower + tree.limits[i].upper);
  }
}

TEST(IkWorld, NoisyTargetsHaveTheStatedSpread) {
  const KinematicTree tree = MakeBodyTree({});
  double shift_squares = 0, axis_squares = 0;
  constexpr int kTrials = 400, kTargets = 4 * kTrials;
  for (int trial = 0; trial < kTrials; ++trial) {
    const IkWorld world = MakeIkWorld(tree, {.target_noise = {.position_cm = 1, .orientation_deg = 3}}, Trial(trial));
    const TreeFrames truth = ComputeFrames(tree, world.truth);
    for (std::size_t e = 0; e < 4; ++e) {
      const EffectorError error = ErrorOf(truth.effectors[e], world.problem.targets[e]);
      shift_squares += error.position * error.position;
      axis_squares += glm::dot(error.axis_angles, error.axis_angles);
    }
  }
  EXPECT_NEAR(std::sqrt(shift_squares / (3 * kTargets)), 0.01, 0.0004);
  // A small rotation vector v moves the three axes by |v × e_k|; the squares sum to 2|v|².
  EXPECT_NEAR(Degrees(std::sqrt(axis_squares / (2 * 3 * kTargets))), 3, 0.12);
}

TEST(IkWorld, AnUnreachableTargetIsJustBeyondEveryPose) {
  const KinematicTree tree = MakeBodyTree({});
  std::vector<bool> was_pulled(4);
  for (int trial = 0; trial < 30; ++trial) {
    IkTrialOptions options;
    const IkWorld near = MakeIkWorld(tree, options, Trial(trial));
    EXPECT_FALSE(IsOutOfReach(tree, near.problem)) << "a control";
    options.unreachable_cm = 5;
    IkWorld world = MakeIkWorld(tree, options, Trial(trial));
    EXPECT_TRUE(IsOutOfReach(tree, world.problem));
    int pulled = 0;
    for (std::size_t e = 0; e < 4; ++e) {
      EffectorTarget& target = world.problem.targets[e];
      if (target.position == near.problem.targets[e].position) continue;
      ++pulled;
      was_pulled[e] = true;
      // The target is out of reach; at 5.01 cm nearer to the root, IsOutOfReach no longer excludes it.
      const glm::dvec3 outward = glm::normalize(target.position - world.problem.start.root_position);
      EXPECT_GT(glm::dot(outward, glm::normalize(near.problem.targets[e].position)), 1 - 1e-12);
      target.position -= 0.0501 * outward;
      EXPECT_FALSE(IsOutOfReach(tree, world.problem));
    }
    EXPECT_EQ(pulled, 1);
  }
  EXPECT_EQ(std::ranges::count(was_pulled, true), 4) << "each has its turn";
}

/// Returns the largest element of the start's gradient JᵀΔX; axis errors are rotation vectors, all weights one.
double LargestGradient(const KinematicTree& tree, const IkProblem& problem) {
  const TreeFrames frames = ComputeFrames(tree, problem.start);
  TreeJacobian jacobian;
  ComputeJacobian(tree, frames, jacobian);
  double largest = 0;
  for (int dof = 0; dof < tree.dof_count(); ++dof) {
    double sum = 0;
    for (std::size_t e = 0; e < problem.targets.size(); ++e) {
      const auto column = jacobian.column(dof).subspan(e * TreeJacobian::kPerEffector);
      glm::dvec3 turn(0);
      for (int k = 0; k < 3; ++k) turn += 0.5 * glm::cross(frames.effectors[e].axes[k], problem.targets[e].axes[k]);
      const glm::dvec3 shift = problem.targets[e].position - frames.effectors[e].position;
      for (int k = 0; k < 3; ++k) sum += column[k] * shift[k] + column[3 + k] * turn[k];
    }
    largest = std::max(largest, std::abs(sum));
  }
  return largest;
}

// Paper B, figure 3.8, left: the arms are stretched, the targets lie along them, and the gradient is zero.
TEST(IkWorld, AStretchedStartHasNoGradientThoughItsTargetsAreElsewhereAndWithinReach) {
  for (const std::string& name : LimitSetNames()) {
    const KinematicTree tree = TreeWith(*FindLimitSet(name));
    for (int trial = 0; trial < 20; ++trial) {
      const IkWorld world = MakeIkWorld(tree, {.start = IkStart::kStretched}, Trial(trial));
      EXPECT_LT(LargestGradient(tree, world.problem), 1e-12) << name;
      EXPECT_GT(LongestError(tree, world.problem.start, world.problem), 0.008);
      EXPECT_LT(LongestError(tree, world.truth, world.problem), 1e-7);
      for (std::size_t i = 0; i < tree.limits.size(); ++i) {
        EXPECT_GE(world.truth.angles[i], tree.limits[i].lower) << name << i;
        EXPECT_LE(world.truth.angles[i], tree.limits[i].upper) << name << i;
      }
      // The targets lie along the hanging arms, and no effector has to turn.
      const TreeFrames start = ComputeFrames(tree, world.problem.start);
      for (std::size_t e = 0; e < 4; ++e) {
        const glm::dvec3 shift = world.problem.targets[e].position - start.effectors[e].position;
        EXPECT_LT(glm::length(glm::cross(shift, start.effectors[e].axes[2])), 1e-12);
        EXPECT_LT(ErrorOf(start.effectors[e], world.problem.targets[e]).MeanAxisAngle(glm::dvec3(1)), 1e-7);
      }
    }
  }
  const KinematicTree tree = MakeBodyTree({});
  EXPECT_GT(LargestGradient(tree, MakeIkWorld(tree, {}, Trial(0)).problem), 1e-3) << "a control";
}

TEST(IkWorld, AsksForPositionsOrAxesAlone) {
  const KinematicTree tree = MakeBodyTree({});
  IkTrialOptions options{.asks_axes = false};
  for (const EffectorTarget& target : MakeIkWorld(tree, options, Trial(0)).problem.targets) {
    EXPECT_EQ(target.position_weight, 1);
    EXPECT_EQ(target.axis_weights, glm::dvec3(0));
  }
  options.asks_axes = true;
  options.asks_positions = false;
  for (const EffectorTarget& target : MakeIkWorld(tree, options, Trial(0)).problem.targets) {
    EXPECT_EQ(target.position_weight, 0);
    EXPECT_EQ(target.axis_weights, glm::dvec3(1));
  }
}

}  // namespace
}  // namespace etude
