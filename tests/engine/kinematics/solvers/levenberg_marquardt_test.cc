
#include <gtest/gtest.h>

#include <cmath>

#include "engine/kinematics/solvers/ceres_lm.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/solvers/jacobian_solvers.h"
#include "engine/kinematics/solvers/linear_targets.h"
#include "tests/engine/kinematics/solvers/any_problem.h"
#include "tests/engine/kinematics/solvers/arms.h"

namespace etude {
namespace {

double CostAt(const IkProblem& problem, const std::vector<double>& angles) {
  TreeState state = problem.start;
  state.angles = angles;
  return LinearTargets(Body(), problem.targets).Cost(ComputeFrames(Body(), state));
}

// The elbow bends by at most 0.9 rad. With the elbow at this limit, only the shoulder's angle decides how near the
// tip is to the target.
TEST(LevenbergMarquardt, FindsTheNearestPoseWhereALimitBinds) {
  KinematicTree arm = Arm({0.5, 0.4}, 1);
  arm.limits[1] = {0, 0.9};
  const glm::dvec3 place = TwoHingeTip(0.5, 0.4, 0.7, 1.4);
  const IkSolution solution = SolveLevenbergMarquardt(arm, Reach(arm, {0.4, 0.3}, place), Exactly());
  EXPECT_EQ(solution.status, IkStatus::kStalled);
  EXPECT_EQ(solution.angles[1], 0.9);
  // The shoulder turns the tip, with the elbow at its limit, towards the target.
  const auto direction = [](const glm::dvec3& p) { return std::atan2(-p.y, p.z - 1); };
  const double turn = direction(place) - direction(TwoHingeTip(0.5, 0.4, 0, 0.9));
  EXPECT_NEAR(solution.angles[0], turn, 1e-6);
}

// A hinge of lever r, δ short of its target: with a = (r / 30 cm)² the sum is a (2 sin δ/2)², and a step a sin δ / (a +
// μ).
TEST(LevenbergMarquardt, FollowsTheRatioOfGainToPromise) {
  const KinematicTree arm = Arm({0.5}, 1);
  const double a = (0.5 / kPositionScale) * (0.5 / kPositionScale), target = 0.9;
  const auto angle_after = [&](int steps, double share) {
    const IkProblem problem = Reach(arm, {0}, {0, -0.5 * std::sin(target), 1 + 0.5 * std::cos(target)});
    return SolveLevenbergMarquardt(arm, problem, {.max_iterations = steps}, {.damping_share = share}).angles[0];
  };
  const auto cost = [&](double off) { return a * std::pow(2 * std::sin(off / 2), 2); };
  for (const double share : {0.5, 2.0}) {
    const double first = a * std::sin(target) / (a + share * cost(target));
    ASSERT_LT(first, kMaxTurn);
    EXPECT_NEAR(angle_after(1, share), first, 1e-12);
    const double promised = 2 * first * a * std::sin(target) - a * first * first;
    const double ratio = (cost(target) - cost(target - first)) / promised;
    const double factor = std::max(1.0 / 3, 1 - std::pow(2 * ratio - 1, 3));
    ASSERT_LT(factor, 1);
    const double off = target - first;
    EXPECT_NEAR(angle_after(2, share), first + a * std::sin(off) / (a + factor * share * cost(off)), 1e-12);
  }
  EXPECT_NEAR(angle_after(1, 1e-6), kMaxTurn, 1e-12) << "steps are of bounded length";
}

// Returns how often the sum rises along a trace. A restart may raise it, and costs one pass more than an iteration.
template <typename Solve>
std::pair<int, int> CountRises(const Solve& solve) {
  int steps = 0, rises = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 1.0), trial, 30);
    IkOptions options = Tightly();
    options.max_iterations = 40;
    options.trace = true;
    const IkSolution solution = solve(problem, options);
    if (solution.fk_evaluations != solution.iterations + 1) continue;
    for (std::size_t i = 1; i < solution.trace.size(); ++i, ++steps) {
      rises += CostAt(problem, solution.trace[i].angles) > CostAt(problem, solution.trace[i - 1].angles);
    }
  }
  return {steps, rises};
}

TEST(LevenbergMarquardt, NeverRaisesTheSumOfSquares) {
  const auto [steps, rises] = CountRises([](const IkProblem& problem, const IkOptions& options) {
    return SolveLevenbergMarquardt(Body(), problem, options);
  });
  EXPECT_GT(steps, 400);
  EXPECT_EQ(rises, 0);
  const auto [others, other_rises] = CountRises(
      [](const IkProblem& problem, const IkOptions& options) { return SolveJacobianPinv(Body(), problem, options); });
  EXPECT_GT(other_rises, others / 20) << "a method that does raise it must show";
}

SolvedMany SolveByMarquardt(int trials, double pose_range, double noise_deg) {
  return SolveMany(trials, pose_range, noise_deg,
                   [](const IkProblem& problem) { return SolveLevenbergMarquardt(Body(), problem, Tightly()); });
}

TEST(LevenbergMarquardt, SolvesKeepsLimitsAndStaysNearTheStart) {
  for (const double pose_range : {0.5, 1.0}) {
    const SolvedMany tally = SolveByMarquardt(400, pose_range, 15);
    EXPECT_EQ(tally.solved, 400) << pose_range;
    EXPECT_EQ(tally.outside, 0) << pose_range;
    EXPECT_LE(tally.hidden, 0.45) << pose_range;
    EXPECT_LE(tally.iterations, 5.5) << pose_range;
  }
}

TEST(LevenbergMarquardt, SolvesFromFarAway) {
  for (const double pose_range : {0.5, 1.0}) {
    const SolvedMany tally = SolveByMarquardt(200, pose_range, 45);
    EXPECT_GE(tally.solved, 199) << pose_range;
    EXPECT_EQ(tally.outside, 0) << pose_range;
    EXPECT_LE(tally.iterations, 16) << pose_range;
  }
}

// Without an active set, limits make the steps of damped least squares very short.
TEST(LevenbergMarquardt, SolvesWhereClampingCrawlsAlongTheLimits) {
  IkOptions options = Tightly();
  options.max_iterations = 25;
  const auto solved_by = [&](Bounds bounds) {
    return SolveMany(200, 1.0, 15,
                     [&](const IkProblem& problem) {
                       return SolveDampedLeastSquares(Body(), problem, options, {.bounds = bounds});
                     })
        .solved;
  };
  const int ours = SolveMany(200, 1.0, 15, [&](const IkProblem& problem) {
                     return SolveLevenbergMarquardt(Body(), problem, options);
                   }).solved;
  EXPECT_EQ(ours, 200);
  EXPECT_GE(solved_by(Bounds::kActiveSet), 190);
  EXPECT_LE(solved_by(Bounds::kClamped), 120) << "else the active set is not what solves them";
}

// Second implementations: `gauss-newton` with its steps along the limbs, and Ceres, which often stops beside the
// minimum if bounds are active.
TEST(LevenbergMarquardt, FindsTheMinimumThatOthersFindWhereTargetsContradictEachOther) {
  int same = 0, held = 0, better = 0;
  for (int trial = 0; trial < 40; ++trial) {
    IkProblem problem = DisturbedProblem(Body(), RandomPose(Body(), trial, 1.0), trial, 3);
    for (EffectorTarget& target : problem.targets) target.axis_weights = {1, 2, 3};
    problem.targets[0].position.y -= 0.10;
    problem.targets[3].position.y += 0.30;
    IkOptions options{.max_iterations = 3000};
    const IkSolution solution = SolveLevenbergMarquardt(Body(), problem, options);
    const double found = CostAt(problem, solution.angles);
    const double by_gauss_newton = CostAt(problem, SolveGaussNewton(Body(), problem, options).angles);
    const double by_ceres = CostAt(problem, SolveCeresLm(Body(), problem, options).angles);
    EXPECT_GT(found, 1e-3) << "contradictions leave something";
    EXPECT_LT(found, 1.0001 * by_ceres) << trial;
    same += std::abs(found - by_gauss_newton) < 1e-3 * found;
    better += found < 0.99 * by_ceres;
    for (int i = 0; i < 29; ++i) {
      held += solution.angles[i] == problem.limits[i].lower || solution.angles[i] == problem.limits[i].upper;
    }
  }
  EXPECT_GE(same, 36);
  EXPECT_GE(better, 15) << "else a comparison that passes by less would do";
  EXPECT_GE(held, 40) << "else no bound was put to the test";
}

TEST(LevenbergMarquardt, GivesAnHonestAnswerToAnyProblem) {
  ExpectHonestAnswersToAnyProblem([](const auto& tree, const auto& problem, const auto& options, int) {
    return SolveLevenbergMarquardt(tree, problem, options);
  });
}

TEST(LevenbergMarquardt, StaysFiniteWithWeightsAndLimbsOfAbsurdSizes) {
  const auto solve = [](const auto& tree, const auto& problem, const auto& options, int) {
    return SolveLevenbergMarquardt(tree, problem, options);
  };
  ExpectFiniteAnswersAtAbsurdSizes(solve, Tightly());
}

// A hinge points slightly beside a target far beyond its reach, so undamped steps overshoot. With lever 1, distance D
// and angle a to the target, the step is D sin a / (1 + μ). A step of more than 2a raises the sum.
TEST(LevenbergMarquardt, DampsARejectedStepByNielsensRule) {
  const KinematicTree arm = Arm({1.0}, 1);
  constexpr double kDistance = 8, kOff = 0.1, kShare = 1e-3;
  const IkProblem problem =
      Reach(arm, {0.5}, {0, -kDistance * std::sin(0.5 - kOff), 1 + kDistance * std::cos(0.5 - kOff)});
  const double square = 1 + kDistance * kDistance - 2 * kDistance * std::cos(kOff);
  double factor = 1, growth = 2, step = 0;
  int rejected = 0;
  for (;; ++rejected, factor *= growth, growth *= 2) {
    step = kDistance * std::sin(kOff) / (1 + factor * kShare * square);
    if (step < 2 * kOff) break;
  }
  ASSERT_EQ(rejected, 3);
  IkOptions options = Exactly();
  options.trace = true;
  const IkSolution solution = SolveLevenbergMarquardt(arm, problem, options, {.damping_share = kShare});
  ASSERT_GT(solution.trace.size(), 4u);
  for (int i = 0; i <= rejected; ++i) EXPECT_EQ(solution.trace[i].angles[0], 0.5) << i;
  EXPECT_NEAR(solution.trace[rejected + 1].angles[0], 0.5 - step, 1e-9);
}

}  // namespace
}  // namespace etude
