#pragma once

#include <optional>

#include "tests/engine/kinematics/random_tree.h"

namespace etude {

struct RandomProblem {
  KinematicTree tree;
  IkProblem problem;
  IkOptions options;
};

/// Makes a random problem: any tree, fixed and free joints, starts outside the limits, zero weights, one or many
/// iterations. Returns nothing for the few trees that cannot move.
inline std::optional<RandomProblem> MakeRandomProblem(int trial) {
  RandomStream random({.suite_seed = 9, .scenario = "null-space-test", .trial = trial}, "problem");
  KinematicTree tree = RandomTree(trial, 4 + trial % 10);
  if (tree.limits.empty()) return std::nullopt;
  for (AngleRange& range : tree.limits) {
    const double lower = random.Uniform(-2, 1);
    range = {lower, lower + (random.Chance(0.2) ? 0 : random.Uniform(0, 3))};
  }
  IkProblem problem = DisturbedProblem(tree, RandomPose(tree, trial, 1.0), trial, 40);
  const auto weight = [&] { return random.Chance(0.3) ? 0 : random.Uniform(0, 3); };
  for (EffectorTarget& target : problem.targets) {
    target.position_weight = weight();
    target.axis_weights = {weight(), weight(), weight()};
    if (random.Chance(0.1)) target.position += random.Normal3();
  }
  for (double& angle : problem.start.angles) angle += random.Chance(0.1) ? 5 : 0;
  IkOptions options{.max_iterations = trial % 3 == 0 ? 1 : 150};
  if (random.Chance(0.2)) options.angle_change_tolerance = random.Uniform(0, 0.3);
  return RandomProblem{std::move(tree), std::move(problem), options};
}

}  // namespace etude
