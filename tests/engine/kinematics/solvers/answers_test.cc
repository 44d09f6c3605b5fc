// The results of every solver, one line per run: how runs end, after how many iterations, and with which errors.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>

#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/solvers/ik_solver.h"
#include "tests/engine/kinematics/solvers/random_problem.h"
#include "tests/support/kept_lines.h"

namespace etude {
namespace {

struct Runs {
  std::array<int, 5> ends{};  ///< by IkStatus
  int iterations = 0, evaluations = 0;
  double off_m = 0, off_rad = 0, angles = 0, traced = 0;

  void Add(const IkSolution& solution) {
    ++ends[static_cast<std::size_t>(solution.status)];
    iterations += solution.iterations;
    evaluations += solution.fk_evaluations;
    for (const EffectorError& error : solution.errors) {
      off_m += error.position;
      for (int i = 0; i < 3; ++i) off_rad += error.axis_angles[i];
    }
    double sign = 1;  // alternating weights, so that errors of two angles do not cancel
    for (const double angle : solution.angles) angles += (sign = -0.9 * sign) * angle;
    for (const IkTraceEntry& entry : solution.trace) traced += entry.worst_position + entry.worst_mean_axis;
  }
  std::string Tell(const std::string& what) const {
    constexpr std::array kEnds = {"converged", "stalled", "unreachable", "out of iterations", "bad input"};
    std::string line = what + ":";
    for (std::size_t i = 0; i < kEnds.size(); ++i) {
      if (ends[i] > 0) line += fmt::format(" {} {},", ends[i], kEnds[i]);
    }
    return line + fmt::format(" {} iterations, {} evaluations; {:.7g} m, {:.7g} rad off; angles {:.7g}, traced {:.7g}",
                              iterations, evaluations, off_m, off_rad, angles, traced);
  }
};

// Returns a problem with uneven weights whose start is disturbed by 15°; in trial 3 one target is moved by 15 cm.
IkProblem UnevenBodyProblem(int trial) {
  IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 0.9), trial, 15);
  problem.targets[trial % 4].axis_weights = {0.5, 0, 2};
  problem.targets[(trial + 1) % 4].position_weight = 0.4;
  if (trial == 3) problem.targets[1].position += glm::dvec3(0.1, 0.05, -0.1);
  return problem;
}

Runs FirstSteps(const IkSolver& solver) {
  Runs runs;
  for (const WeightRule rule : {WeightRule::kAdaptive, WeightRule::kFixedTuned, WeightRule::kWangChen,
                                WeightRule::kAdaptivePower, WeightRule::kAdaptiveTuned}) {
    for (const WeightRefresh refresh : {WeightRefresh::kSweep, WeightRefresh::kJoint, WeightRefresh::kDof}) {
      const bool by_default = rule == WeightRule::kAdaptive && refresh == WeightRefresh::kSweep;
      if (!by_default && !solver.uses_weights) continue;
      for (int trial = 0; trial < (solver.uses_weights ? 1 : 4); ++trial) {
        IkOptions options{.weights = rule, .refresh = refresh, .max_iterations = 3, .trace = true};
        runs.Add(solver.solve(Body(), UnevenBodyProblem(trial), options));
      }
    }
  }
  return runs;
}

Runs OnAnyTree(const IkSolver& solver, bool by_default) {
  Runs runs;
  for (int trial = 0; trial < 60; ++trial) {
    const auto made = MakeRandomProblem(trial);
    if (!made) continue;
    IkOptions options = made->options;
    // Near convergence, extrapolation amplifies rounding.
    options.max_iterations = 1 + trial % (solver.name == "ccd-anderson" ? 5 : 18);
    options.trace = trial % 4 == 1;
    if (!by_default) {
      options.limits = trial % 5 != 0;
      options.position_goal = 0.05;
      options.axis_goal = 0.1;
      options.stall_change = 1e-3;
      options.max_trace_entries = 3;
      for (const IkSolverSetting& setting : solver.settings) {
        setting.set(options.solver_settings, setting.number.is_whole ? 3 : setting.number.fallback * 0.4 + 0.01);
      }
    }
    runs.Add(solver.solve(made->tree, made->problem, options));
  }
  return runs;
}

TEST(EverySolver, ComesToWhatItCameTo) {
  std::vector<std::string> lines;
  for (const IkSolver& solver : AllIkSolvers()) {
    lines.push_back(FirstSteps(solver).Tell(solver.name + ", first steps of a body"));
    lines.push_back(OnAnyTree(solver, true).Tell(solver.name + ", any tree"));
    lines.push_back(OnAnyTree(solver, false).Tell(solver.name + ", other settings"));
  }
  EXPECT_TRUE(testing::AreKept(lines, "tests/engine/kinematics/solvers/answers.txt"));
}

TEST(GaussNewtonBatch, ComesToWhatItCameTo) {
  std::vector<IkProblem> problems;
  for (int trial = 0; trial < 13; ++trial) problems.push_back(UnevenBodyProblem(trial));
  problems[4].limits[2] = {1, -1};
  problems[7].targets[0].position += glm::dvec3(0, 9, 0);
  std::vector<std::string> lines;
  for (const Precision precision : {Precision::kFloat, Precision::kDouble}) {
    for (const GaussNewtonOptions& own :
         {GaussNewtonOptions{}, {.first_sweeps = 2, .extra_passes = 1, .restarts = 2}}) {
      for (const int iterations : {3, 12}) {
        IkOptions options{.max_iterations = iterations, .position_goal = 5e-4};
        if (own.restarts == 2) options.angle_change_tolerance = 0.4;
        Runs runs;
        for (const IkSolution& solution : SolveGaussNewtonBatch(Body(), problems, options, precision, own)) {
          runs.Add(solution);
        }
        lines.push_back(
            runs.Tell(fmt::format("{}, {} restarts, {} iterations at most",
                                  precision == Precision::kFloat ? "float" : "double", own.restarts, iterations)));
      }
    }
  }
  EXPECT_TRUE(testing::AreKept(lines, "tests/engine/kinematics/solvers/batches.txt"));
}

}  // namespace
}  // namespace etude
