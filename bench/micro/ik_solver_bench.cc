// Times every solver on the same 200 trials: poses over half and over all of each joint's range, with practical and
// with tight goals. The time column is one pass over all trials. Counters:
//   solved      share of trials that met the goals
//   hidden      root mean square error of the angles, divided by the standard deviation of the start's noise
//   median_us   median over the trials of each trial's fastest time
//   iterations  median over the trials
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/ik_solver.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr int kTrials = 200;
constexpr double kNoiseDeg = 15;

struct IkTrial {
  TreeState truth;
  IkProblem problem;
};

/// Makes `count` trials, the same in every call. Truth: uniform within `pose_range` of every joint's range, about its
/// middle; start: truth + Gaussian noise, clipped to the range; targets: the effectors of the truth.
std::vector<IkTrial> MakeIkTrials(const KinematicTree& tree, int count, double pose_range, double joint_noise_deg) {
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

double SquaredHiddenError(const IkTrial& trial, std::span<const double> angles) {
  double sum = 0;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double off = angles[i] - trial.truth.angles[i];
    sum += off * off;
  }
  return sum;
}

IkOptions Options(bool is_tight) {
  IkOptions options;
  options.weights = WeightRule::kAdaptivePower;
  options.max_iterations = 1000;
  if (is_tight) {
    options.position_goal = 1e-5;
    options.axis_goal = Radians(1e-3);
  }
  return options;
}

double Median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}

void Solve(benchmark::State& state, const IkSolver& solver, double pose_range, bool is_tight) {
  using Clock = std::chrono::steady_clock;
  const KinematicTree tree = MakeBodyTree({});
  const std::vector<IkTrial> trials = MakeIkTrials(tree, kTrials, pose_range, kNoiseDeg);
  const IkOptions options = Options(is_tight);
  // Solve all trials, and keep each one's fastest time.
  std::vector<double> least_us(trials.size(), std::numeric_limits<double>::infinity());
  std::vector<IkSolution> solutions(trials.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const auto begin = Clock::now();
      solutions[i] = solver.solve(tree, trials[i].problem, options);
      const std::chrono::duration<double, std::micro> took = Clock::now() - begin;
      least_us[i] = std::min(least_us[i], took.count());
    }
  }
  // Summarise the solutions.
  int solved = 0;
  double squares = 0;
  std::vector<double> iterations;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    solved += solutions[i].status == IkStatus::kConverged;
    squares += SquaredHiddenError(trials[i], solutions[i].angles);
    iterations.push_back(solutions[i].iterations);
  }
  state.counters["solved"] = static_cast<double>(solved) / kTrials;
  state.counters["hidden"] = std::sqrt(squares / (kTrials * tree.dof_count())) / Radians(kNoiseDeg);
  state.counters["median_us"] = Median(least_us);
  state.counters["iterations"] = Median(iterations);
}

const bool kAreRegistered = [] {
  for (const bool is_tight : {false, true}) {
    for (const double pose_range : {0.5, 1.0}) {
      for (const IkSolver& solver : AllIkSolvers()) {
        const std::string name = std::string(is_tight ? "tight" : "practical") +
                                 (pose_range < 1 ? "/half_range/" : "/full_range/") + solver.name;
        benchmark::RegisterBenchmark(name.c_str(), [=, &solver](benchmark::State& state) {
          Solve(state, solver, pose_range, is_tight);
        })->Unit(benchmark::kMillisecond);
      }
    }
  }
  return true;
}();

}  // namespace
}  // namespace etude
