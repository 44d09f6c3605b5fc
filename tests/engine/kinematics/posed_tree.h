#pragma once

#include <algorithm>

#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"
#include "sim/random/stream.h"

namespace etude {

/// Returns paper B's body with default lengths.
inline const KinematicTree& Body() {
  static const KinematicTree tree = MakeBodyTree({});
  return tree;
}

/// Returns a pose of `tree`, uniform in the middle `share` of every joint's range, at a random position and heading.
inline TreeState RandomPose(const KinematicTree& tree, int trial, double share) {
  RandomStream random({.suite_seed = 7, .scenario = "kinematics-test", .trial = trial}, "pose");
  TreeState state = StandingState(tree);
  state.root_position = random.Normal3();
  const double yaw = random.Uniform(-kPi, kPi), c = std::cos(yaw), s = std::sin(yaw);
  state.root_frame = glm::dmat3(c, 0, -s, 0, 1, 0, s, 0, c) * state.root_frame;
  for (std::size_t i = 0; i < state.angles.size(); ++i) {
    const AngleRange& range = tree.limits[i];
    state.angles[i] =
        0.5 * (range.lower + range.upper) + 0.5 * share * (range.upper - range.lower) * random.Uniform(-1, 1);
  }
  return state;
}

/// Returns the problem of finding `truth` from angles with noise of deviation `noise_deg`.
inline IkProblem DisturbedProblem(const KinematicTree& tree, const TreeState& truth, int trial, double noise_deg) {
  RandomStream random({.suite_seed = 7, .scenario = "kinematics-test", .trial = trial}, "noise");
  IkProblem problem{truth, {}, tree.limits};
  for (std::size_t i = 0; i < truth.angles.size(); ++i) {
    const double angle = truth.angles[i] + Radians(noise_deg) * random.Normal();
    problem.start.angles[i] = std::clamp(angle, tree.limits[i].lower, tree.limits[i].upper);
  }
  for (const LimbFrame& effector : ComputeFrames(tree, truth).effectors) {
    problem.targets.push_back({.position = effector.position, .axes = effector.axes});
  }
  return problem;
}

}  // namespace etude
