#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/engine/kinematics/solvers/random_problem.h"

namespace etude {

/// Returns options with goals of 10⁻³ cm and 10⁻³°.
inline IkOptions Tightly(int max_iterations = 1000) {
  IkOptions options{.position_goal = 1e-5, .axis_goal = Radians(1e-3)};
  options.max_iterations = max_iterations;
  return options;
}

struct SolvedMany {
  int solved = 0, outside = 0;
  double hidden = 0;  ///< root mean square angle error, in units of the noise
  double iterations = 0;
};

template <typename Solve>
SolvedMany SolveMany(int trials, double pose_range, double noise_deg, const Solve& solve) {
  SolvedMany tally;
  double squares = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const TreeState truth = RandomPose(Body(), trial, pose_range);
    const IkSolution solution = solve(DisturbedProblem(Body(), truth, trial, noise_deg));
    tally.solved += solution.status == IkStatus::kConverged;
    tally.iterations += solution.iterations;
    for (std::size_t d = 0; d < truth.angles.size(); ++d) {
      const double angle = solution.angles[d], off = angle - truth.angles[d];
      squares += off * off;
      tally.outside += !(angle >= Body().limits[d].lower && angle <= Body().limits[d].upper);
    }
  }
  tally.hidden = std::sqrt(squares / (trials * Body().dof_count())) / Radians(noise_deg);
  tally.iterations /= trials;
  return tally;
}

/// A solver under test; the last argument is the number of the trial.
using SolverOnTrial =
    std::function<IkSolution(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, int trial)>;

/// Runs random problems, some solvable. Checks that angles stay within their ranges and that the status is true.
inline void ExpectHonestAnswersToAnyProblem(const SolverOnTrial& solve) {
  int converged = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const auto made = MakeRandomProblem(trial);
    if (!made) continue;
    const auto& [tree, problem, options] = *made;
    const IkSolution solution = solve(tree, problem, options, trial);
    const std::vector<AngleRange> ranges = AllowedRanges(problem, options);
    for (std::size_t d = 0; d < ranges.size(); ++d) {
      EXPECT_TRUE(solution.angles[d] >= ranges[d].lower && solution.angles[d] <= ranges[d].upper) << trial;
    }
    EXPECT_LE(solution.iterations, options.max_iterations) << trial;
    const bool is_met = FindWorst(solution.errors, problem.targets).Within(options);
    EXPECT_EQ(solution.status == IkStatus::kConverged, is_met) << trial;
    if (solution.status == IkStatus::kIterationLimit) {
      EXPECT_EQ(solution.iterations, options.max_iterations) << trial;
    }
    converged += is_met;
  }
  EXPECT_GT(converged, 50);
  EXPECT_LT(converged, 450);
}

/// Runs problems with a body of some 100 km, a target beyond its reach, and weights from nearly zero to a million.
/// Checks that answers are finite.
inline void ExpectFiniteAnswersAtAbsurdSizes(const SolverOnTrial& solve, const IkOptions& options) {
  KinematicTree tree = Body();
  for (TreeJoint& joint : tree.joints) joint.p_PJ *= 1e5;
  for (const double weight : {1e-300, 1e-9, 1e6}) {
    IkProblem problem = DisturbedProblem(tree, RandomPose(tree, 3, 1.0), 3, 30);
    for (EffectorTarget& target : problem.targets) target.position_weight = weight;
    problem.targets[0].position = {1e6, -1e6, 1e6};
    const IkSolution solution = solve(tree, problem, options, 0);
    EXPECT_NE(solution.status, IkStatus::kBadInput);
    for (const double angle : solution.angles) EXPECT_TRUE(std::isfinite(angle)) << weight;
    for (const EffectorError& error : solution.errors) EXPECT_TRUE(std::isfinite(error.position)) << weight;
  }
}

}  // namespace etude
