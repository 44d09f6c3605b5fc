#include <gtest/gtest.h>

#include <limits>

#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/solvers/gauss_newton_vectors.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/solvers/any_problem.h"
#include "tests/engine/kinematics/solvers/plain_gauss_newton.h"

namespace etude {
namespace {

// Poses near the limits with distant starts or impossible targets; some need extra passes and restarts.
std::vector<IkProblem> HardProblems(int count) {
  std::vector<IkProblem> problems;
  for (int trial = 0; trial < count; ++trial) {
    problems.push_back(DisturbedProblem(Body(), RandomPose(Body(), trial, 1.0), trial, trial % 3 == 0 ? 60 : 15));
    std::vector<EffectorTarget>& targets = problems.back().targets;
    if (trial % 7 == 0) targets[trial % 4].position.y += 0.02;
    if (trial % 11 == 0) targets[0].position.x += 3;
    if (trial % 5 == 0) targets[1].position_weight = 0;
    if (trial % 6 == 0) targets[2].axis_weights = {0, 0, 1};
  }
  return problems;
}

void ExpectSameBits(const IkSolution& a, const IkSolution& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.fk_evaluations, b.fk_evaluations);
  EXPECT_EQ(a.angles, b.angles);
  ASSERT_EQ(a.errors.size(), b.errors.size());
  for (std::size_t e = 0; e < a.errors.size(); ++e) {
    EXPECT_EQ(a.errors[e].position, b.errors[e].position);
    EXPECT_EQ(a.errors[e].axis_angles, b.errors[e].axis_angles);
  }
  ASSERT_EQ(a.trace.size(), b.trace.size());
  for (std::size_t i = 0; i < a.trace.size(); ++i) {
    EXPECT_EQ(a.trace[i].angles, b.trace[i].angles);
    EXPECT_EQ(a.trace[i].worst_position, b.trace[i].worst_position);
    EXPECT_EQ(a.trace[i].worst_axis, b.trace[i].worst_axis);
  }
}

void ExpectAllSameBits(const std::vector<IkSolution>& a, const std::vector<IkSolution>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(i);
    ExpectSameBits(a[i], b[i]);
  }
}

TEST(GaussNewtonBatch, InDoubleIsTheSolverOfOneProblemToTheLastBit) {
  const std::vector<IkProblem> problems = HardProblems(61);
  IkOptions bound = Tightly(200);
  bound.angle_change_tolerance = 0.5;
  IkOptions free = Tightly(200);
  free.limits = false;
  int with_restarts = 0, out_of_reach = 0;
  for (const IkOptions& options : {Tightly(200), Tightly(7), bound, free, IkOptions{}}) {
    for (const GaussNewtonOptions& own :
         {GaussNewtonOptions{}, GaussNewtonOptions{.first_sweeps = 2}, GaussNewtonOptions{.extra_passes = 0}}) {
      std::vector<IkSolution> expected;
      for (const IkProblem& problem : problems) {
        expected.push_back(SolveGaussNewton(Body(), problem, options, own));
        with_restarts += expected.back().iterations > 20;
        out_of_reach += expected.back().status == IkStatus::kUnreachable;
      }
      ExpectAllSameBits(SolveGaussNewtonBatch(Body(), problems, options, Precision::kDouble, own), expected);
    }
  }
  EXPECT_GT(with_restarts, 100);
  EXPECT_GT(out_of_reach, 10);
}

// Compares the fast solver, which computes limbs side by side in SIMD lanes and the trunk's joints one by one, with the
// plain scalar solver. Tries every vector instruction set, and none.
TEST(GaussNewton, IsTheSolverOneWouldWriteDownToTheLastBit) {
  const std::vector<IkProblem> problems = HardProblems(61);
  IkOptions bound = Tightly(200);
  bound.angle_change_tolerance = 0.5;
  IkOptions free = Tightly(200);
  free.limits = false;
  IkOptions traced = Tightly(200);
  traced.trace = true;
  std::vector<std::string> targets = BatchTargets();
  targets.push_back("");
  for (const std::string& target : targets) {
    SCOPED_TRACE(target);
    SetBatchTarget(target);
    GaussNewtonSolver solver(Body());
    SetBatchTarget("");
    for (const IkOptions& options : {Tightly(200), Tightly(7), bound, free, traced}) {
      for (const GaussNewtonOptions& own :
           {GaussNewtonOptions{}, GaussNewtonOptions{.first_sweeps = 2}, GaussNewtonOptions{.extra_passes = 0}}) {
        for (const IkProblem& problem : problems) {
          ExpectSameBits(solver.Solve(problem, options, own), SolveGaussNewtonPlainly(Body(), problem, options, own));
        }
      }
    }
  }
}

TEST(GaussNewton, IsThatSolverOnAnyTree) {
  int compared = 0;
  for (const std::string& target : BatchTargets()) {
    SCOPED_TRACE(target);
    for (int trial = 0; trial < 300; ++trial) {
      const auto made = MakeRandomProblem(trial);
      if (!made) continue;
      SCOPED_TRACE(trial);
      const auto& [tree, problem, options] = *made;
      SetBatchTarget(target);
      ExpectSameBits(SolveGaussNewton(tree, problem, options), SolveGaussNewtonPlainly(tree, problem, options));
      ++compared;
    }
  }
  SetBatchTarget("");
  EXPECT_GT(compared, 100);
}

// Trees of any shape: joints that share no axes, several effectors on a limb, limbs without effectors.
TEST(GaussNewtonBatch, IsTheSolverOfOneProblemOnAnyTree) {
  int compared = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const auto made = MakeRandomProblem(trial);
    if (!made) continue;
    SCOPED_TRACE(trial);
    const auto& [tree, problem, options] = *made;
    ExpectSameBits(SolveGaussNewtonBatch(tree, {&problem, 1}, options, Precision::kDouble)[0],
                   SolveGaussNewton(tree, problem, options));
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

TEST(GaussNewtonBatch, GivesTheSameBitsWithEveryKindOfVectors) {
  const std::vector<IkProblem> problems = HardProblems(67);
  const std::vector<std::string> targets = BatchTargets();
  if (targets.size() < 2) GTEST_SKIP() << "this CPU has the narrowest vectors only";
  std::vector<std::vector<double>> seen;
  for (const Precision precision : {Precision::kFloat, Precision::kDouble}) {
    SetBatchTarget(targets[0]);
    const std::vector<IkSolution> widest = SolveGaussNewtonBatch(Body(), problems, Tightly(200), precision);
    for (std::size_t t = 1; t < targets.size(); ++t) {
      SCOPED_TRACE(targets[t]);
      SetBatchTarget(targets[t]);
      ExpectAllSameBits(SolveGaussNewtonBatch(Body(), problems, Tightly(200), precision), widest);
    }
    seen.push_back(widest[1].angles);
  }
  SetBatchTarget("");
  EXPECT_NE(seen[0], seen[1]) << "floats and doubles must differ, or no bit was compared";
}

TEST(GaussNewtonBatch, NoProblemFeelsItsNeighbours) {
  std::vector<IkProblem> problems = HardProblems(50);
  for (const Precision precision : {Precision::kFloat, Precision::kDouble}) {
    const std::vector<IkSolution> together = SolveGaussNewtonBatch(Body(), problems, Tightly(200), precision);
    std::vector<IkProblem> backwards(problems.rbegin(), problems.rend());
    std::vector<IkSolution> reversed = SolveGaussNewtonBatch(Body(), backwards, Tightly(200), precision);
    std::ranges::reverse(reversed);
    ExpectAllSameBits(reversed, together);
    for (const int i : {0, 7, 49}) {
      ExpectSameBits(SolveGaussNewtonBatch(Body(), {&problems[i], 1}, Tightly(200), precision)[0], together[i]);
    }
  }
  EXPECT_TRUE(SolveGaussNewtonBatch(Body(), std::span<const IkProblem>(), Tightly(200), Precision::kFloat).empty());
}

TEST(GaussNewtonBatch, InFloatSolvesWhatDoublesSolve) {
  const std::vector<IkProblem> problems = HardProblems(200);
  const std::vector<IkSolution> in_double = SolveGaussNewtonBatch(Body(), problems, Tightly(200), Precision::kDouble);
  const std::vector<IkSolution> in_float = SolveGaussNewtonBatch(Body(), problems, Tightly(200), Precision::kFloat);
  int solved = 0;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    SCOPED_TRACE(i);
    if (in_double[i].status == IkStatus::kConverged) {
      EXPECT_EQ(in_float[i].status, IkStatus::kConverged);
    }
    const bool is_met = FindWorst(in_float[i].errors, problems[i].targets).Within(Tightly(200));
    EXPECT_EQ(in_float[i].status == IkStatus::kConverged, is_met);
    for (std::size_t d = 0; d < in_float[i].angles.size(); ++d) {
      EXPECT_GE(in_float[i].angles[d], Body().limits[d].lower);
      EXPECT_LE(in_float[i].angles[d], Body().limits[d].upper);
    }
    solved += is_met;
  }
  EXPECT_GT(solved, 100);
  EXPECT_LT(solved, 200) << "some cannot be met";
}

TEST(GaussNewtonBatch, GivesAnHonestAnswerToAnyProblem) {
  for (const Precision precision : {Precision::kFloat, Precision::kDouble}) {
    const auto solve = [=](const auto& tree, const auto& problem, const auto& options, int) {
      return SolveGaussNewtonBatch(tree, {&problem, 1}, options, precision)[0];
    };
    ExpectHonestAnswersToAnyProblem(solve);
    ExpectFiniteAnswersAtAbsurdSizes(solve, Tightly(200));
  }
}

TEST(GaussNewtonBatch, ABadProblemIsBadForItselfOnly) {
  std::vector<IkProblem> problems = HardProblems(9);
  const std::vector<IkSolution> sound = SolveGaussNewtonBatch(Body(), problems, Tightly(200), Precision::kDouble);
  const auto spoil = [&](int kind, IkProblem& problem) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (kind == 0) problem.targets[1].position.x = kNone;
    if (kind == 1) problem.start.angles.pop_back();
    if (kind == 2) std::swap(problem.limits[3].lower, problem.limits[3].upper);
    if (kind == 3) problem.targets[2].axes[1] *= 1.001;
    if (kind == 4) problem.targets[2].axes[1] *= -1;
    if (kind == 5) problem.targets[0].axis_weights.y = -1;
    if (kind == 6) problem.start.root_position.z = 2e6;
    if (kind == 7) problem.start.angles[28] = kNone;
  };
  for (int kind = 0; kind < 8; ++kind) {
    SCOPED_TRACE(kind);
    std::vector<IkProblem> spoilt = problems;
    spoil(kind, spoilt[4]);
    EXPECT_FALSE(FindFault(Body(), spoilt[4], Tightly(200)).empty());
    const std::vector<IkSolution> batch = SolveGaussNewtonBatch(Body(), spoilt, Tightly(200), Precision::kDouble);
    for (std::size_t i = 0; i < problems.size(); ++i) {
      if (i != 4) ExpectSameBits(batch[i], sound[i]);
    }
    EXPECT_EQ(batch[4].status, IkStatus::kBadInput);
    EXPECT_EQ(batch[4].angles, std::vector<double>(29, 0.0));
  }
  EXPECT_NE(sound[4].status, IkStatus::kBadInput) << "sound before the fault";
  EXPECT_EQ(SolveGaussNewtonBatch(Body(), problems, Tightly(0), Precision::kDouble)[4].status, IkStatus::kBadInput);
}

}  // namespace
}  // namespace etude
