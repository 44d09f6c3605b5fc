// What a whole solution costs, by solver: the same 200 trials for all, poses of half the joints' ranges and of all of
// them, stopped at practical and at tight goals. The counters say what came of it:
//   solved      share of the trials that met the goals
//   hidden      root mean square of the angles' distance from the truth, in units of the start's
//   median_us   the median trial's time, each trial's being the least of all passes
//   iterations  the median trial's
// The time column is that of one pass over all trials.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "bench/micro/ik_trials.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/ik_solver.h"

namespace etude {
namespace {

constexpr int kTrials = 200;
constexpr double kNoiseDeg = 15;

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
