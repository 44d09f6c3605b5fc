// Our inverse kinematics and that of other libraries, side by side: the same problems, the same accuracy, one after the
// other in one process. Every problem is timed by itself, the best of all rounds counts, and the median over the
// problems is shown; whether a problem is solved is judged by our forward kinematics and the limits.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <map>

#include "bench/micro/ik_trials.h"
#include "bench/micro/kdl_peer.h"
#include "bench/micro/simbody_peer.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/ik_solver.h"

namespace etude {
namespace {

constexpr int kTrials = 200;
constexpr double kJointNoiseDeg = 15;
constexpr char kOurs[] = "gauss-newton";
constexpr int kRounds = 5;  // as many for everyone: the best of more would look better

struct Method {
  std::string name;
  std::function<std::vector<double>(const IkProblem&)> solve;
};

// Solved tightly (algorithms, B6): 10⁻³ cm and 10⁻³°.
IkOptions Tightly(int max_iterations) {
  IkOptions options;
  options.weights = WeightRule::kAdaptivePower;
  options.position_goal = 1e-5;
  options.axis_goal = Radians(1e-3);
  options.max_iterations = max_iterations;
  return options;
}

IkOptions Practically() { return IkOptions{}; }

const KinematicTree& Body() {
  static const KinematicTree tree = MakeBodyTree({});
  return tree;
}

bool IsSolved(const IkProblem& problem, const std::vector<double>& angles, const IkOptions& goals) {
  constexpr double kRounding = 1e-9;  // of limits, radians
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const AngleRange& range = problem.limits[i];
    if (!(angles[i] >= range.lower - kRounding && angles[i] <= range.upper + kRounding)) return false;
  }
  TreeState state = problem.start;
  state.angles = angles;
  std::vector<EffectorError> errors;
  MeasureErrors(ComputeFrames(Body(), state), problem.targets, errors);
  return FindWorst(errors, problem.targets).Within(goals);
}

Method Ours(const std::string& solver, int max_iterations, std::vector<double> settings = {}, std::string name = {}) {
  IkOptions options = Tightly(max_iterations);
  options.solver_settings = std::move(settings);
  return {name.empty() ? solver : name, [options, found = FindIkSolver(solver)](const IkProblem& problem) {
            return found->solve(Body(), problem, options).angles;
          }};
}

// A model that is not our tree would be compared on other problems than ours: no numbers then.
Method Peer(const std::string& name, std::shared_ptr<IkPeer> peer) {
  constexpr double kRounding = 1e-9;
  for (const IkTrial& trial : MakeIkTrials(Body(), 20, 1.0, kJointNoiseDeg)) {
    const std::vector<LimbFrame> found = peer->Effectors(trial.truth.angles);
    for (std::size_t e = 0; e < found.size(); ++e) {
      const EffectorTarget& expected = trial.problem.targets[e];
      double off = glm::distance(found[e].position, expected.position);
      for (int k = 0; k < 3; ++k) off = std::max(off, glm::distance(found[e].axes[k], expected.axes[k]));
      if (off > kRounding) {
        fmt::print(stderr, "{}: its {} is {} away from ours; the models differ\n", name, Body().effectors[e].name, off);
        std::exit(1);
      }
    }
  }
  return {name, [peer, options = Tightly(1000)](const IkProblem& problem) { return peer->Solve(problem, options); }};
}

// Processor time, so that a solution of many milliseconds does not pay for what else the machine does.
double ThreadTimeUs() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

// Of the method that the others are compared with, by pose range.
std::map<double, double> our_medians;

void Measure(benchmark::State& state, const Method& method, double pose_range) {
  const std::vector<IkTrial> trials = MakeIkTrials(Body(), kTrials, pose_range, kJointNoiseDeg);
  std::vector<double> fastest_us(trials.size(), std::numeric_limits<double>::infinity());
  std::vector<std::vector<double>> angles(trials.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const double begin = ThreadTimeUs();
      angles[i] = method.solve(trials[i].problem);
      fastest_us[i] = std::min(fastest_us[i], ThreadTimeUs() - begin);
    }
  }
  int tightly = 0, practically = 0;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    tightly += IsSolved(trials[i].problem, angles[i], Tightly(1));
    practically += IsSolved(trials[i].problem, angles[i], Practically());
  }
  std::ranges::nth_element(fastest_us, fastest_us.begin() + kTrials / 2);
  const double median = fastest_us[kTrials / 2];
  if (method.name == kOurs) our_medians[pose_range] = median;
  state.counters["solved_%"] = 100.0 * tightly / kTrials;
  state.counters["practically_%"] = 100.0 * practically / kTrials;
  state.counters["median_us"] = median;
  if (our_medians.contains(pose_range)) state.counters["times_ours"] = median / our_medians[pose_range];
}

std::vector<Method> AllMethods() {
  return {
      Ours(kOurs, 200),
      Ours("levenberg-marquardt", 200),
      Ours("damped-least-squares-active-set", 1000),
      Ours("damped-least-squares", 1000),
      Ours("jacobian-pinv-active-set", 1000),
      Ours("jacobian-pinv", 1000),
      Ours("ccd-anderson", 1000),
      Ours("ccd-hinges", 2000),
      Ours("ceres-lm", 1000, {10}, "ceres-lm/radius 10"),
      Ours("ceres-lm", 1000, {1}, "ceres-lm/radius 1"),
      Peer("kdl-online", MakeKdlOnline(Body(), {})),
      Peer("kdl-newton", MakeKdlNewton(Body(), {.damping = 0.03, .position_weight = 1})),
      Peer("simbody-assembler", MakeSimbodyAssembler(Body(), {})),
  };
}

}  // namespace
}  // namespace etude

int main(int argc, char** argv) {
  const std::vector<etude::Method> methods = etude::AllMethods();
  for (const double pose_range : {0.5, 1.0}) {
    for (const etude::Method& method : methods) {
      benchmark::RegisterBenchmark(
          fmt::format("f={}/{}", pose_range, method.name).c_str(),
          [&method, pose_range](benchmark::State& state) { etude::Measure(state, method, pose_range); })
          ->Iterations(etude::kRounds)
          ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
