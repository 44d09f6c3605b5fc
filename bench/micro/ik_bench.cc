// What inverse kinematics costs: one forward-kinematics pass, one sweep by weight rule, one whole solution by solver.
#include <benchmark/benchmark.h>

#include <cmath>

#include "engine/kinematics/solvers/ccd_sweep.h"
#include "engine/kinematics/solvers/ik_solver.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "engine/kinematics/tree.h"

namespace etude {
namespace {

// A pose inside the limits, half way out in a pattern that leaves no joint at rest, and a start 15° away from it.
IkProblem MakeProblem(const KinematicTree& tree) {
  TreeState truth = StandingState(tree);
  IkProblem problem{truth, {}, tree.limits};
  for (std::size_t i = 0; i < tree.limits.size(); ++i) {
    const AngleRange& range = tree.limits[i];
    const double middle = 0.5 * (range.lower + range.upper), half = 0.5 * (range.upper - range.lower);
    truth.angles[i] = middle + 0.5 * half * std::sin(1.0 + 2.0 * static_cast<double>(i));
    problem.start.angles[i] = truth.angles[i] + Radians(15) * std::cos(3.0 * static_cast<double>(i));
  }
  for (const LimbFrame& effector : ComputeFrames(tree, truth).effectors) {
    problem.targets.push_back({effector.position, effector.axes});
  }
  return problem;
}

void ForwardKinematics(benchmark::State& state) {
  const KinematicTree tree = MakeBodyTree({});
  const TreeState pose = MakeProblem(tree).start;
  TreeFrames frames;
  for (auto _ : state) {
    ComputeFrames(tree, pose, frames);
    benchmark::DoNotOptimize(frames.effectors.data());
  }
}
BENCHMARK(ForwardKinematics);

void Sweep(benchmark::State& state, CcdJoint joint_kind, WeightRule rule, WeightRefresh refresh) {
  const KinematicTree tree = MakeBodyTree({});
  const IkProblem problem = MakeProblem(tree);
  IkOptions options;
  options.weights = rule;
  options.refresh = refresh;
  CcdSweep ccd(tree, problem, options, joint_kind);
  for (auto _ : state) benchmark::DoNotOptimize(ccd.Sweep());
}
BENCHMARK_CAPTURE(Sweep, ccd_fixed, CcdJoint::kWhole, WeightRule::kFixed, WeightRefresh::kSweep);
BENCHMARK_CAPTURE(Sweep, ccd_adaptive, CcdJoint::kWhole, WeightRule::kAdaptive, WeightRefresh::kSweep);
BENCHMARK_CAPTURE(Sweep, ccd_adaptive_per_dof, CcdJoint::kWhole, WeightRule::kAdaptive, WeightRefresh::kDof);
BENCHMARK_CAPTURE(Sweep, hinges_fixed, CcdJoint::kHinges, WeightRule::kFixed, WeightRefresh::kSweep);
BENCHMARK_CAPTURE(Sweep, hinges_adaptive, CcdJoint::kHinges, WeightRule::kAdaptive, WeightRefresh::kSweep);

void MomentFormSweep(benchmark::State& state, WeightRule rule) {
  const KinematicTree tree = MakeBodyTree({});
  const IkProblem problem = MakeProblem(tree);
  IkOptions options;
  options.weights = rule;
  MomentSweep ccd(tree, problem, options);
  for (auto _ : state) benchmark::DoNotOptimize(ccd.Sweep());
}
BENCHMARK_CAPTURE(MomentFormSweep, fixed, WeightRule::kFixed);
BENCHMARK_CAPTURE(MomentFormSweep, adaptive, WeightRule::kAdaptive);
BENCHMARK_CAPTURE(MomentFormSweep, adaptive_power, WeightRule::kAdaptivePower);

void Solve(benchmark::State& state, const char* solver, WeightRule rule) {
  const KinematicTree tree = MakeBodyTree({});
  const IkProblem problem = MakeProblem(tree);
  IkOptions options;
  options.weights = rule;
  options.max_iterations = 2000;
  IkSolution solution;
  for (auto _ : state) {
    solution = FindIkSolver(solver)->solve(tree, problem, options);
    benchmark::DoNotOptimize(solution.angles.data());
  }
  state.counters["iterations"] = solution.iterations;
  state.counters["converged"] = solution.status == IkStatus::kConverged;
}
BENCHMARK_CAPTURE(Solve, ccd_fixed_tuned, "ccd", WeightRule::kFixedTuned);
BENCHMARK_CAPTURE(Solve, ccd_adaptive_power, "ccd", WeightRule::kAdaptivePower);
BENCHMARK_CAPTURE(Solve, hinges_adaptive_power, "ccd-hinges", WeightRule::kAdaptivePower);
BENCHMARK_CAPTURE(Solve, damped_least_squares, "damped-least-squares", WeightRule::kFixed);

}  // namespace
}  // namespace etude
