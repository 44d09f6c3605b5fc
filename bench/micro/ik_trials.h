#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"
#include "sim/random/stream.h"

namespace etude {

/// One problem of inverse kinematics whose answer is known.
struct IkTrial {
  TreeState truth;
  IkProblem problem;
};

/// The trials of scenarios, `count` of them: truth uniform in `pose_range` of every joint's range about its middle,
/// start = truth + Gaussian noise, clipped, targets = where the truth has its effectors. The same at every call.
inline std::vector<IkTrial> MakeIkTrials(const KinematicTree& tree, int count, double pose_range,
                                         double joint_noise_deg) {
  std::vector<IkTrial> trials(count);
  for (int trial = 0; trial < count; ++trial) {
    const WorldKey key{.suite_seed = 1, .scenario = "ik-micro", .trial = trial};
    RandomStream pose(key, "pose"), noise(key, "joint-noise");
    IkTrial& made = trials[trial];
    made.truth = StandingState(tree);
    made.problem = {made.truth, {}, tree.limits};
    for (std::size_t i = 0; i < tree.limits.size(); ++i) {
      const AngleRange& range = tree.limits[i];
      const double middle = 0.5 * (range.lower + range.upper), half = 0.5 * (range.upper - range.lower);
      made.truth.angles[i] = middle + pose_range * half * pose.Uniform(-1, 1);
      const double disturbed = made.truth.angles[i] + Radians(joint_noise_deg) * noise.Normal();
      made.problem.start.angles[i] = std::clamp(disturbed, range.lower, range.upper);
    }
    for (const LimbFrame& effector : ComputeFrames(tree, made.truth).effectors) {
      made.problem.targets.push_back({effector.position, effector.axes});
    }
  }
  return trials;
}

/// Σ (angle − truth)² over all angles, radians².
inline double SquaredHiddenError(const IkTrial& trial, std::span<const double> angles) {
  double sum = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double off = angles[i] - trial.truth.angles[i];
    sum += off * off;
  }
  return sum;
}

}  // namespace etude
