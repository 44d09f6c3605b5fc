#include "engine/kinematics/solvers/batch_sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "engine/kinematics/solvers/ccd.h"
#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

constexpr WeightRule kServedRules[] = {WeightRule::kFixed, WeightRule::kFixedTuned, WeightRule::kAdaptive,
                                       WeightRule::kAdaptiveTuned, WeightRule::kAdaptivePower};

std::vector<IkProblem> SomeProblems(int count) {
  std::vector<IkProblem> problems;
  for (int trial = 0; trial < count; ++trial) {
    problems.push_back(DisturbedProblem(Body(), RandomPose(Body(), trial, 0.8), trial, 10));
  }
  return problems;
}

IkOptions Options(WeightRule rule, int max_iterations) {
  IkOptions options;
  options.weights = rule;
  options.max_iterations = max_iterations;
  return options;
}

// Every bit of the numbers of a solution.
std::string Bytes(const IkSolution& solution) {
  std::string bytes(sizeof(double) * solution.angles.size(), '\0');
  std::memcpy(bytes.data(), solution.angles.data(), bytes.size());
  for (const EffectorError& error : solution.errors) {
    const double numbers[] = {error.position, error.axis_angles.x, error.axis_angles.y, error.axis_angles.z};
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof(numbers));
  }
  return bytes;
}

void ExpectSame(const IkSolution& a, const IkSolution& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.iterations, b.iterations);
  EXPECT_EQ(a.fk_evaluations, b.fk_evaluations);
  EXPECT_EQ(Bytes(a), Bytes(b));
}

TEST(BatchSweep, InDoubleIsTheSolverOfOneProblemToTheLastBit) {
  const std::vector<IkProblem> problems = SomeProblems(21);  // some lanes stay empty at the end
  for (const WeightRule rule : kServedRules) {
    const IkOptions options = Options(rule, 80);
    const std::vector<IkSolution> batch = SolveCcdBatch(Body(), problems, options, Precision::kDouble);
    ASSERT_EQ(batch.size(), problems.size());
    for (std::size_t i = 0; i < problems.size(); ++i) {
      SCOPED_TRACE(WeightRuleNames()[static_cast<int>(rule)] + " " + std::to_string(i));
      ExpectSame(batch[i], SolveCcdHinges(Body(), problems[i], options));
    }
  }
}

TEST(BatchSweep, GivesTheSameBytesWithEveryKindOfVectors) {
  const std::vector<IkProblem> problems = SomeProblems(37);
  const std::vector<std::string> targets = BatchTargets();
  if (targets.size() < 2) GTEST_SKIP() << "this CPU has the narrowest vectors only";
  std::vector<std::string> seen;
  for (const Precision precision : {Precision::kFloat, Precision::kDouble}) {
    for (const WeightRule rule : {WeightRule::kFixedTuned, WeightRule::kAdaptivePower}) {
      const IkOptions options = Options(rule, 60);
      SetBatchTarget(targets[0]);
      const std::vector<IkSolution> widest = SolveCcdBatch(Body(), problems, options, precision);
      for (std::size_t t = 1; t < targets.size(); ++t) {
        SetBatchTarget(targets[t]);
        const std::vector<IkSolution> other = SolveCcdBatch(Body(), problems, options, precision);
        for (std::size_t i = 0; i < problems.size(); ++i) {
          SCOPED_TRACE(targets[t] + " " + std::to_string(i));
          ExpectSame(other[i], widest[i]);
        }
      }
      seen.push_back(Bytes(widest[0]));
    }
  }
  SetBatchTarget("");
  EXPECT_NE(seen[0], seen[2]) << "floats and doubles must differ, or no byte was compared";
}

TEST(BatchSweep, NoProblemFeelsItsNeighbours) {
  const std::vector<IkProblem> problems = SomeProblems(40);
  const IkOptions options = Options(WeightRule::kAdaptivePower, 60);
  const std::vector<IkSolution> together = SolveCcdBatch(Body(), problems, options, Precision::kFloat);
  for (const int i : {0, 7, 39}) {
    const std::vector<IkSolution> alone = SolveCcdBatch(Body(), {&problems[i], 1}, options, Precision::kFloat);
    ASSERT_EQ(alone.size(), 1u);
    ExpectSame(alone[0], together[i]);
  }
  EXPECT_TRUE(SolveCcdBatch(Body(), {}, options, Precision::kFloat).empty());
}

TEST(BatchSweep, InFloatReachesTightGoals) {
  const std::vector<IkProblem> problems = SomeProblems(12);
  IkOptions options = Options(WeightRule::kAdaptivePower, 20000);
  options.position_goal = 1e-5;
  options.axis_goal = Radians(1e-3);
  for (const IkSolution& solution : SolveCcdBatch(Body(), problems, options, Precision::kFloat)) {
    EXPECT_EQ(solution.status, IkStatus::kConverged);
    for (std::size_t i = 0; i < solution.angles.size(); ++i) {
      EXPECT_GE(solution.angles[i], Body().limits[i].lower);
      EXPECT_LE(solution.angles[i], Body().limits[i].upper);
    }
    for (const EffectorError& error : solution.errors) EXPECT_LT(error.position, 1e-5);
  }
}

TEST(BatchSweep, ABadProblemIsBadForItselfOnly) {
  std::vector<IkProblem> problems = SomeProblems(9);
  const IkOptions options = Options(WeightRule::kFixedTuned, 40);
  const std::vector<IkSolution> sound = SolveCcdBatch(Body(), problems, options, Precision::kDouble);
  problems[4].targets[1].position.x = std::numeric_limits<double>::quiet_NaN();
  const std::vector<IkSolution> batch = SolveCcdBatch(Body(), problems, options, Precision::kDouble);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    if (i != 4) ExpectSame(batch[i], sound[i]);
  }
  EXPECT_EQ(batch[4].status, IkStatus::kBadInput);
  EXPECT_EQ(batch[4].angles, std::vector<double>(29, 0.0));
  EXPECT_NE(sound[4].status, IkStatus::kBadInput) << "sound before the fault";
}

TEST(BatchSweep, RefusesWeightsThatMomentsCannotCarry) {
  const std::vector<IkProblem> problems = SomeProblems(2);
  IkOptions options = Options(WeightRule::kWangChen, 40);
  EXPECT_EQ(SolveCcdBatch(Body(), problems, options, Precision::kDouble)[1].status, IkStatus::kBadInput);
  options = Options(WeightRule::kAdaptive, 40);
  options.refresh = WeightRefresh::kDof;
  EXPECT_EQ(SolveCcdBatch(Body(), problems, options, Precision::kDouble)[0].status, IkStatus::kBadInput);
}

TEST(BatchSweep, TracesEverySweepLikeTheSolverOfOneProblem) {
  const std::vector<IkProblem> problems = SomeProblems(3);
  IkOptions options = Options(WeightRule::kAdaptive, 10);
  options.trace = true;
  const std::vector<IkSolution> batch = SolveCcdBatch(Body(), problems, options, Precision::kDouble);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const IkSolution one = SolveCcdHinges(Body(), problems[i], options);
    ASSERT_EQ(batch[i].trace.size(), one.trace.size());
    EXPECT_EQ(batch[i].trace.size(), 11u) << "the start and ten sweeps";
    for (std::size_t k = 0; k < one.trace.size(); ++k) EXPECT_EQ(batch[i].trace[k].angles, one.trace[k].angles);
  }
}

TEST(BatchSweep, FreesAnglesWhenLimitsAreOff) {
  const std::vector<IkProblem> problems = SomeProblems(5);
  IkOptions options = Options(WeightRule::kAdaptivePower, 60);
  options.limits = false;
  const std::vector<IkSolution> batch = SolveCcdBatch(Body(), problems, options, Precision::kDouble);
  for (std::size_t i = 0; i < problems.size(); ++i) ExpectSame(batch[i], SolveCcdHinges(Body(), problems[i], options));
}

}  // namespace
}  // namespace etude
