
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/ccd.h"
#include "sim/random/stream.h"
#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

IkProblem Problem(int trial, double noise_deg = 15) {
  return DisturbedProblem(Body(), RandomPose(Body(), trial, 0.5), trial, noise_deg);
}

IkOptions Options(WeightRule rule) {
  IkOptions options{.weights = rule, .max_iterations = 3000};
  return options;
}

template <class Solve, class... Own>
int MedianSweeps(Solve solve, const IkOptions& options, const Own&... own) {
  std::vector<int> sweeps;
  for (int trial = 0; trial < 15; ++trial) sweeps.push_back(solve(Body(), Problem(trial), options, own...).iterations);
  std::ranges::sort(sweeps);
  return sweeps[sweeps.size() / 2];
}

TEST(CcdAnderson, NeedsFarFewerSweepsThanPlainOnes) {
  const auto ratio = [](const IkOptions& options) {
    return 1.0 * MedianSweeps(SolveCcdHinges, options) / MedianSweeps(SolveCcdAnderson, options, CcdAndersonOptions());
  };
  EXPECT_GT(ratio(Options(WeightRule::kFixedTuned)), 4);
  EXPECT_GT(ratio(Options(WeightRule::kAdaptivePower)), 3);
  // These weights cannot use the moment form of the sweep.
  EXPECT_GT(ratio(Options(WeightRule::kWangChen)), 3);
  IkOptions at_every_dof = Options(WeightRule::kAdaptivePower);
  at_every_dof.refresh = WeightRefresh::kDof;
  EXPECT_GT(ratio(at_every_dof), 2);
}

TEST(CcdAnderson, GainsFromMemory) {
  const auto sweeps = [](int memory) {
    return MedianSweeps(SolveCcdAnderson, Options(WeightRule::kFixedTuned), CcdAndersonOptions{.memory = memory});
  };
  EXPECT_LT(sweeps(5), sweeps(1));
}

/// Returns the largest turn of a plain sweep from these angles.
double NextTurn(IkProblem problem, const std::vector<double>& angles, const IkOptions& options) {
  problem.start.angles = angles;
  return CcdSweep(Body(), problem, options, CcdJoint::kHinges).Sweep();
}

TEST(CcdAnderson, RestsWherePlainSweepsRest) {
  for (const WeightRule rule : {WeightRule::kFixedTuned, WeightRule::kAdaptivePower, WeightRule::kWangChen}) {
    IkOptions options = Options(rule);
    options.position_goal = options.axis_goal = 0;  // run to the fixed point
    options.stall_change = 1e-8;
    for (int trial = 0; trial < 3; ++trial) {
      const IkProblem problem = Problem(trial);
      const IkSolution solution = SolveCcdAnderson(Body(), problem, options);
      EXPECT_EQ(solution.status, IkStatus::kStalled) << WeightRuleNames()[static_cast<int>(rule)];
      EXPECT_LT(NextTurn(problem, solution.angles, options), 1e-6);
      EXPECT_GT(NextTurn(problem, problem.start.angles, options), 1e-2) << "else any pose would do";
    }
  }
}

TEST(CcdAnderson, NeverRaisesWhatSweepsLower) {
  IkOptions options = Options(WeightRule::kFixedTuned);
  options.trace = true;
  int dropped = 0;
  for (int trial = 0; trial < 5; ++trial) {
    const IkSolution solution = SolveCcdAnderson(Body(), Problem(trial, 30), options);
    double last = std::numeric_limits<double>::infinity();
    for (const IkTraceEntry& entry : solution.trace) {
      double merit = 0;
      for (const EffectorError& error : entry.errors) {
        merit += 0.0015 * 1e4 * error.position * error.position;
        for (int k = 0; k < 3; ++k) merit += 2 - 2 * std::cos(error.axis_angles[k]);
      }
      EXPECT_LE(merit, last * (1 + 1e-9) + 1e-14);
      last = merit;
    }
    // Forward kinematics runs once for the start, once per sweep, and once per dropped extrapolation.
    dropped += solution.fk_evaluations - solution.iterations - 1;
  }
  EXPECT_GT(dropped, 0) << "no extrapolation had to be dropped: nothing was tested";
}

// At half a turn, tan((q − middle) / 2) has its pole.
TEST(CcdAnderson, TurnsAFreeAngleByHalfATurn) {
  IkOptions options = Options(WeightRule::kFixedTuned);
  options.limits = false;
  const int neck_twist = Body().joints[kTreeNeck].first_dof + 2;
  for (const double more : {0.0, 1e-12, 1e-6, 1e-3}) {
    IkProblem problem = Problem(0, 0);
    problem.start.angles[neck_twist] += kPi - more;
    const IkSolution solution = SolveCcdAnderson(Body(), problem, options);
    EXPECT_EQ(solution.status, IkStatus::kConverged) << more;
    EXPECT_LE(solution.iterations, 3) << "one sweep finds it";
    EXPECT_NEAR(std::abs(solution.angles[neck_twist] - problem.start.angles[neck_twist]), kPi, 1e-2);
  }
}

TEST(CcdAnderson, IsPlainSweepsAsLongAsAnAngleIsAtThePole) {
  const int neck_twist = Body().joints[kTreeNeck].first_dof + 2;
  for (const WeightRule rule : {WeightRule::kFixedTuned, WeightRule::kWangChen}) {
    IkOptions options = Options(rule);
    options.limits = false;
    options.position_goal = options.axis_goal = options.stall_change = 0;
    IkProblem problem = Problem(0, 0.2);
    problem.start.angles[neck_twist] += kPi;
    for (options.max_iterations = 1; options.max_iterations <= 4; ++options.max_iterations) {
      const IkSolution ours = SolveCcdAnderson(Body(), problem, options);
      const IkSolution plain = SolveCcdHinges(Body(), problem, options);
      ASSERT_GT(std::abs(ours.angles[neck_twist] - problem.start.angles[neck_twist]), kPi - 0.019) << "the pole";
      for (std::size_t d = 0; d < plain.angles.size(); ++d) EXPECT_NEAR(ours.angles[d], plain.angles[d], 1e-9);
      for (std::size_t e = 0; e < plain.errors.size(); ++e) {
        EXPECT_NEAR(ours.errors[e].position, plain.errors[e].position, 1e-9);
      }
    }
  }
}

using Vectors = std::vector<Eigen::VectorXd>;

Eigen::VectorXd RandomVector(RandomStream& random, int size) {
  Eigen::VectorXd v(size);
  for (double& entry : v) entry = random.Normal();
  return v;
}

Eigen::VectorXd Extrapolate(AndersonMixing& mixing, const Eigen::VectorXd& x, const Eigen::VectorXd& g) {
  Eigen::VectorXd out(x.size());
  mixing.Extrapolate({x.data(), x.data() + x.size()}, {g.data(), g.data() + g.size()},
                     {out.data(), out.data() + out.size()});
  return out;
}

// The same extrapolation by Eigen, from all pairs so far.
Eigen::VectorXd ByQr(const Vectors& xs, const Vectors& gs, int memory) {
  const int last = static_cast<int>(xs.size()) - 1, count = std::min(memory, last);
  if (count == 0) return gs[last];
  Eigen::MatrixXd df(xs[0].size(), count), dg(xs[0].size(), count);
  for (int i = 0; i < count; ++i) {
    dg.col(i) = gs[last - i] - gs[last - i - 1];
    df.col(i) = dg.col(i) - (xs[last - i] - xs[last - i - 1]);
  }
  return gs[last] - dg * df.colPivHouseholderQr().solve(gs[last] - xs[last]);
}

TEST(AndersonMixing, SolvesItsLeastSquaresAsEigenDoes) {
  constexpr int kSize = 12;
  for (const int memory : {1, 2, 5}) {
    RandomStream random({.suite_seed = 3, .scenario = "anderson-test", .trial = memory}, "pairs");
    AndersonMixing mixing(kSize, memory);
    Vectors xs, gs;
    for (int pair = 0; pair < 12; ++pair) {
      xs.push_back(RandomVector(random, kSize));
      gs.push_back(RandomVector(random, kSize));
      const Eigen::VectorXd out = Extrapolate(mixing, xs.back(), gs.back());
      EXPECT_LT((out - ByQr(xs, gs, memory)).norm(), 1e-9 * (1 + out.norm())) << memory << ", pair " << pair;
    }
  }
}

// For a linear g, n + 1 pairs of n numbers determine the fixed point (Walker and Ni 2011, theorem 2.2).
TEST(AndersonMixing, FindsTheFixedPointOfALinearMapInAsManyStepsAsItHasDimensions) {
  constexpr int kSize = 4;
  RandomStream random({.suite_seed = 3, .scenario = "anderson-test", .trial = 0}, "map");
  const Eigen::MatrixXd map = 0.5 * Eigen::MatrixXd::NullaryExpr(kSize, kSize, [&] { return random.Normal(); });
  const Eigen::VectorXd shift = RandomVector(random, kSize);
  const Eigen::VectorXd fixed = (Eigen::MatrixXd::Identity(kSize, kSize) - map).partialPivLu().solve(shift);
  const auto distance_after = [&](int memory) {
    AndersonMixing mixing(kSize, memory);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(kSize);
    for (int step = 0; step <= kSize; ++step) x = Extrapolate(mixing, x, map * x + shift);
    return (x - fixed).norm();
  };
  EXPECT_LT(distance_after(kSize), 1e-9);
  EXPECT_GT(distance_after(1), 1e-3) << "so little memory cannot know it";
}

TEST(AndersonMixing, TakesNothingFromPairsThatSayTheSameTwice) {
  AndersonMixing mixing(2, 3);
  const Eigen::Vector2d x(1, 2), g(1.5, 2), x2(1.5, 2), g2(1.75, 2);
  Extrapolate(mixing, x, g);
  const Eigen::VectorXd once = Extrapolate(mixing, x2, g2);
  EXPECT_NEAR(once[0], 2, 1e-12) << "steps that halve: 1, 1.5, 1.75, … 2";
  EXPECT_EQ(Extrapolate(mixing, x2, g2), once) << "a difference of zero changes nothing";
}

TEST(AndersonMixing, BeginsAnewAfterDiscarding) {
  AndersonMixing mixing(2, 3);
  const Eigen::Vector2d x(1, 2), g(1.5, 2), x2(1.5, 2), g2(1.75, 2);
  EXPECT_EQ(Extrapolate(mixing, x, g), g);
  mixing.Discard();
  EXPECT_EQ(Extrapolate(mixing, x2, g2), g2);
}

}  // namespace
}  // namespace etude
