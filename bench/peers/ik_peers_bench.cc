// Times Etude's inverse kinematics, for single problems and in batches, and the inverse kinematics of other libraries.
// All methods solve the same problems to the same accuracy in one process. In every round, every method solves every
// problem. The median and the mean of the problems' shortest times are reported. A problem is solved if, by Etude's
// forward kinematics, every effector's position and axes are within the goals, and all angles are within their limits.
//
//     ik_peers_bench [--trials=50] [--rounds=3] [--only=comma-separated parts of methods' names]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>
#include <memory>
#include <ranges>
#include <string_view>

#include "bench/peers/ik_peers.h"
#include "bench/tasks/ik/world.h"
#include "engine/base/text.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/solvers/gauss_newton_vectors.h"
#include "engine/kinematics/solvers/ik_run.h"
#include "engine/kinematics/solvers/ik_solver.h"
#include "tests/engine/kinematics/solvers/plain_gauss_newton.h"

namespace etude {
namespace {

constexpr int kSeeds = 4;
constexpr char kCompared[] = "gauss-newton, plain";  // the method whose time is the unit of relative times

const KinematicTree& Body() {
  static const KinematicTree tree = MakeBodyTree({});
  return tree;
}

// Returns options with the tight goals: 10⁻³ cm and 10⁻³°.
IkOptions Tightly(int max_iterations) {
  IkOptions options;
  options.weights = WeightRule::kAdaptivePower;
  options.position_goal = 1e-5;
  options.axis_goal = Radians(1e-3);
  options.max_iterations = max_iterations;
  return options;
}

// Returns the thread's processor time in microseconds. Other processes do not affect it.
double ThreadTimeUs() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

// Returns the time that it takes to read the clock, microseconds. This time matters if a solution takes only
// microseconds.
double ClockTimeUs() {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 10000; ++i) {
    const double begin = ThreadTimeUs();
    least = std::min(least, ThreadTimeUs() - begin);
  }
  return least;
}

struct Outcome {
  IkPeerAnswer answer;
  double us = std::numeric_limits<double>::infinity();
};

/// One method of the comparison. `solve` solves all problems once; `outcomes` keeps the shortest time of each problem.
struct Method {
  std::string name;
  std::function<void(std::span<const IkWorld> worlds, std::vector<Outcome>& outcomes)> solve;
};

template <class Solve>
Method OneByOne(std::string name, Solve solve) {
  static const double clock_us = ClockTimeUs();
  return {std::move(name), [solve](std::span<const IkWorld> worlds, std::vector<Outcome>& outcomes) {
            for (std::size_t i = 0; i < worlds.size(); ++i) {
              const double begin = ThreadTimeUs();
              IkPeerAnswer answer = solve(worlds[i].problem);
              outcomes[i].us = std::min(outcomes[i].us, ThreadTimeUs() - begin - clock_us);
              outcomes[i].answer = std::move(answer);
            }
          }};
}

Method Ours(const std::string& solver, int max_iterations, const SolverSettings& settings = {}, std::string name = {}) {
  IkOptions options = Tightly(max_iterations);
  options.solver_settings = settings;
  return OneByOne(name.empty() ? solver : name, [options, found = FindIkSolver(solver)](const IkProblem& problem) {
    IkSolution solution = found->solve(Body(), problem, options);
    return IkPeerAnswer{std::move(solution.angles), solution.iterations};
  });
}

// Returns the method of Etude's plain Gauss–Newton solver, without SIMD.
Method Plain() {
  return OneByOne(kCompared, [options = Tightly(200)](const IkProblem& problem) {
    IkSolution solution = SolveGaussNewtonPlainly(Body(), problem, options);
    return IkPeerAnswer{std::move(solution.angles), solution.iterations};
  });
}

// Returns the method that solves one problem after the other. Its tree is prepared once, as are the models of the other
// libraries.
Method Single(const std::string& target) {
  SetBatchTarget(target);
  const auto solver = std::make_shared<GaussNewtonSolver>(Body());
  SetBatchTarget("");
  return OneByOne(fmt::format("gauss-newton, {}", target), [solver, options = Tightly(200)](const IkProblem& problem) {
    IkSolution solution = solver->Solve(problem, options);
    return IkPeerAnswer{std::move(solution.angles), solution.iterations};
  });
}

// Returns the method that solves all problems in one batch. Every problem gets the same time: the batch's time divided
// by the number of problems.
Method Batch(const std::string& target, Precision precision) {
  const std::string name =
      fmt::format("gauss-newton, batch in {}, {}", precision == Precision::kFloat ? "float" : "double", target);
  return {name, [=](std::span<const IkWorld> worlds, std::vector<Outcome>& outcomes) {
            IkBatch problems(Body(), static_cast<int>(worlds.size()));
            for (std::size_t i = 0; i < worlds.size(); ++i) problems.Set(static_cast<int>(i), worlds[i].problem);
            SetBatchTarget(target);
            const double begin = ThreadTimeUs();
            const IkBatchSolution solution = SolveGaussNewtonBatch(Body(), problems, Tightly(200), precision);
            const double us = (ThreadTimeUs() - begin) / static_cast<double>(worlds.size());
            SetBatchTarget("");
            for (std::size_t i = 0; i < worlds.size(); ++i) {
              outcomes[i].us = std::min(outcomes[i].us, us);
              outcomes[i].answer = {{}, solution.iterations[i]};
              for (int d = 0; d < Body().dof_count(); ++d)
                outcomes[i].answer.angles.push_back(solution.angles_of(d)[i]);
            }
          }};
}

// Returns the method of another library. Ends the program if the library's model differs from Etude's tree, because the
// library would then solve different problems.
Method Peer(const std::string& name, std::shared_ptr<IkPeer> peer, int max_iterations) {
  constexpr double kRounding = 1e-9;
  for (int trial = 0; trial < 20; ++trial) {
    const IkWorld world = MakeIkWorld(Body(), IkTrialOptions{}, {.scenario = "ik-peers", .trial = trial});
    const std::vector<LimbFrame> found = peer->Effectors(world.truth.angles);
    for (std::size_t e = 0; e < found.size(); ++e) {
      const EffectorTarget& expected = world.problem.targets[e];
      double off = glm::distance(found[e].position, expected.position);
      for (int k = 0; k < 3; ++k) off = std::max(off, glm::distance(found[e].axes[k], expected.axes[k]));
      if (off > kRounding) {
        fmt::print(stderr, "{}: its {} is {} away from ours; the models differ\n", name, Body().effectors[e].name, off);
        std::exit(1);
      }
    }
  }
  return OneByOne(name, [peer, options = Tightly(max_iterations)](const IkProblem& problem) {
    return peer->Solve(problem, options);
  });
}

std::vector<Method> AllMethods() {
  std::vector<Method> methods = {Plain(), Ours("gauss-newton", 200, {}, "gauss-newton, tree prepared each time")};
  for (const std::string& target : BatchTargets()) {
    methods.push_back(Single(target));
    for (const Precision precision : {Precision::kDouble, Precision::kFloat}) {
      methods.push_back(Batch(target, precision));
    }
  }
  methods.push_back(Peer(fmt::format("dense rival ({})", DensePeerFlags()), MakeDensePeer(Body()), 200));
  methods.push_back(Ours("levenberg-marquardt", 200));
  methods.push_back(Ours("damped-least-squares-active-set", 1000));
  for (const double radius : {1.0, 10.0, 100.0}) {
    methods.push_back(Ours("ceres-lm", 1000, {.first_radius = radius}, fmt::format("ceres-lm, radius {}", radius)));
  }
  methods.push_back(Peer("KDL online", MakeKdlOnline(Body(), {}), 1000));
  methods.push_back(Peer("KDL Newton", MakeKdlNewton(Body(), {.damping = 0.03, .position_weight = 1}), 1000));
  methods.push_back(Peer("KDL Newton, restarts",
                         MakeKdlNewton(Body(), {.damping = 0.03, .position_weight = 1, .restarts = kRestarts}), 1000));
  methods.push_back(Peer("Simbody", MakeSimbodyAssembler(Body(), {}), 1000));
  return methods;
}

struct Condition {
  std::string name;
  IkTrialOptions options;
};

std::vector<Condition> AllConditions() {
  IkTrialOptions whole;
  whole.pose_range = 1;
  IkTrialOptions cold = whole, stretched, noisy = whole;
  cold.start = IkStart::kMiddle;
  stretched.start = IkStart::kStretched;
  noisy.target_noise = {.position_cm = 1, .orientation_deg = 3};
  return {{"f = 0.5", IkTrialOptions{}},
          {"f = 1", whole},
          {"cold, from the middle of every range", cold},
          {"a stretched limb", stretched},
          {"targets off by 1 cm and 3°", noisy}};
}

bool IsSolved(const IkProblem& problem, const std::vector<double>& angles) {
  constexpr double kRounding = 1e-9;  // tolerance of limits, radians
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const AngleRange& range = problem.limits[i];
    if (!(angles[i] >= range.lower - kRounding && angles[i] <= range.upper + kRounding)) return false;
  }
  TreeState state = problem.start;
  state.angles = angles;
  std::vector<EffectorError> errors;
  MeasureErrors(ComputeFrames(Body(), state), problem.targets, errors);
  return FindWorst(errors, problem.targets).Within(Tightly(1));
}

double Median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values[values.size() / 2];
}
double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

struct Times {
  double median = 0, mean = 0;
};

void PrintRow(const Method& method, std::span<const IkWorld> worlds, const std::vector<Outcome>& outcomes,
              Times& compared) {
  std::vector<double> times, hidden, steps;
  int solved = 0;
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    const std::vector<double>& angles = outcomes[i].answer.angles;
    solved += IsSolved(worlds[i].problem, angles);
    times.push_back(outcomes[i].us);
    double squares = 0;
    for (std::size_t d = 0; d < angles.size(); ++d) {
      squares += (angles[d] - worlds[i].truth.angles[d]) * (angles[d] - worlds[i].truth.angles[d]);
    }
    hidden.push_back(Degrees(std::sqrt(squares / static_cast<double>(angles.size()))));
    steps.push_back(outcomes[i].answer.steps);
  }
  const Times own{Median(times), Mean(times)};
  if (method.name == kCompared) compared = own;
  const auto ratio = [](double time, double to) { return to > 0 ? fmt::format("{:.2f}", time / to) : "–"; };
  const double median_steps = Median(steps);
  fmt::print("| {} | {:.1f} % | {:.1f} | {} | {:.2f} | {:.2f} | {} | {} |\n", method.name,
             100.0 * solved / static_cast<double>(worlds.size()), Median(hidden),
             median_steps < 0 ? "–" : fmt::format("{:g}", median_steps), own.median, own.mean,
             ratio(own.median, compared.median), ratio(own.mean, compared.mean));
  std::fflush(stdout);
}

void Compare(const Condition& condition, const std::vector<Method>& methods, int trials, int rounds) {
  std::vector<IkWorld> worlds;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    for (int trial = 0; trial < trials; ++trial) {
      worlds.push_back(
          MakeIkWorld(Body(), condition.options, {.suite_seed = seed, .scenario = "ik-peers", .trial = trial}));
    }
  }
  std::vector<std::vector<Outcome>> outcomes(methods.size(), std::vector<Outcome>(worlds.size()));
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t m = 0; m < methods.size(); ++m) methods[m].solve(worlds, outcomes[m]);
  }
  fmt::print("\n{} ({} problems, {} seeds)\n\n", condition.name, worlds.size(), kSeeds);
  fmt::print("| | solved | hidden, ° | steps | median, µs | mean, µs | median / plain | mean / plain |\n");
  fmt::print("|---|---|---|---|---|---|---|---|\n");
  Times compared;
  for (std::size_t m = 0; m < methods.size(); ++m) PrintRow(methods[m], worlds, outcomes[m], compared);
}

// Reads the number after `key` in `argument`. Returns false if the argument does not begin with `key`, or if the number
// is invalid.
bool Read(std::string_view argument, std::string_view key, int& number) {
  if (!argument.starts_with(key)) return false;
  argument.remove_prefix(key.size());
  number = ParseNumber<int>(argument).value_or(0);
  return number > 0;
}

int Run(std::span<char* const> arguments) {
  int trials = 50, rounds = 3;
  std::string_view only;
  for (const std::string_view argument : arguments) {
    if (argument.starts_with("--only=")) {
      only = argument.substr(7);
    } else if (!Read(argument, "--trials=", trials) && !Read(argument, "--rounds=", rounds)) {
      fmt::print(stderr, "ik_peers_bench: {}: only --trials=N, --rounds=N, --only=NAME,NAME\n", argument);
      return 2;
    }
  }
  const auto is_asked_for = [only](const Method& method) {
    for (const auto part : std::views::split(only, ',')) {
      if (method.name.find(std::string_view(part.begin(), part.end())) != std::string::npos) return true;
    }
    return only.empty() || method.name == kCompared;
  };
  std::vector<Method> methods = AllMethods();
  std::erase_if(methods, [&](const Method& method) { return !is_asked_for(method); });
  for (const Condition& condition : AllConditions()) Compare(condition, methods, trials, rounds);
  return 0;
}

}  // namespace
}  // namespace etude

int main(int argc, char** argv) { return etude::Run({argv + 1, argv + argc}); }
