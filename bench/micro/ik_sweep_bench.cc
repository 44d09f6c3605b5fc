// Times one sweep of cyclic coordinate descent (CCD). CcdSweep, the sweep of paper B (engine/kinematics/README.md),
// visits one effector after the other, with whole joints or with hinges; the moment form of hinges treats all effectors
// at once. For comparison, the program also times forward kinematics alone. The counter `per_sweep` is the time per
// problem and sweep, including forward kinematics and error measurement.
#include <benchmark/benchmark.h>

#include <cmath>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/ccd.h"
#include "engine/kinematics/solvers/moment_sweep.h"
#include "engine/kinematics/tree.h"

namespace etude {
namespace {

// Makes a problem whose true angles lie within the middle half of every range and differ from the rest angles. The
// start differs from the truth by up to 15° per angle.
IkProblem MakeProblem(const KinematicTree& tree, double phase = 1) {
  TreeState truth = StandingState(tree);
  IkProblem problem{truth, {}, tree.limits};
  for (std::size_t i = 0; i < tree.limits.size(); ++i) {
    const AngleRange& range = tree.limits[i];
    const double middle = 0.5 * (range.lower + range.upper), half = 0.5 * (range.upper - range.lower);
    truth.angles[i] = middle + 0.5 * half * std::sin(phase + 2.0 * static_cast<double>(i));
    problem.start.angles[i] = truth.angles[i] + Radians(15) * std::cos(3.0 * static_cast<double>(i));
  }
  for (const LimbFrame& effector : ComputeFrames(tree, truth).effectors) {
    problem.targets.push_back({effector.position, effector.axes});
  }
  return problem;
}

void CountSweeps(benchmark::State& state, double sweeps) {
  state.counters["per_sweep"] = benchmark::Counter(sweeps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
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
  CountSweeps(state, static_cast<double>(state.iterations()));
}
BENCHMARK_CAPTURE(Sweep, whole_joints_fixed_tuned, CcdJoint::kWhole, WeightRule::kFixedTuned, WeightRefresh::kSweep);
BENCHMARK_CAPTURE(Sweep, whole_joints_adaptive_power, CcdJoint::kWhole, WeightRule::kAdaptivePower,
                  WeightRefresh::kSweep);
BENCHMARK_CAPTURE(Sweep, whole_joints_adaptive_power_per_dof, CcdJoint::kWhole, WeightRule::kAdaptivePower,
                  WeightRefresh::kDof);
BENCHMARK_CAPTURE(Sweep, hinges_fixed_tuned, CcdJoint::kHinges, WeightRule::kFixedTuned, WeightRefresh::kSweep);
BENCHMARK_CAPTURE(Sweep, hinges_adaptive_power, CcdJoint::kHinges, WeightRule::kAdaptivePower, WeightRefresh::kSweep);
BENCHMARK_CAPTURE(Sweep, hinges_wang_chen, CcdJoint::kHinges, WeightRule::kWangChen, WeightRefresh::kSweep);

void MomentForm(benchmark::State& state, WeightRule rule) {
  const KinematicTree tree = MakeBodyTree({});
  const IkProblem problem = MakeProblem(tree);
  IkOptions options;
  options.weights = rule;
  MomentSweep ccd(tree, problem, options);
  for (auto _ : state) {
    benchmark::DoNotOptimize(ccd.Sweep());
    benchmark::DoNotOptimize(ccd.MissesGoals());
  }
  CountSweeps(state, static_cast<double>(state.iterations()));
}
BENCHMARK_CAPTURE(MomentForm, fixed_tuned, WeightRule::kFixedTuned);
BENCHMARK_CAPTURE(MomentForm, adaptive, WeightRule::kAdaptive);
BENCHMARK_CAPTURE(MomentForm, adaptive_power, WeightRule::kAdaptivePower);

}  // namespace
}  // namespace etude
