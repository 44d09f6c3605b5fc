#include <gtest/gtest.h>

#include <cmath>

#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/solvers/ik_solver.h"
#include "tests/engine/kinematics/posed_tree.h"
#include "tests/engine/kinematics/rest_bodies.h"

namespace etude {
namespace {

struct SomeBody {
  CaptureBody body;
  double share;  // share of the angles' ranges from which poses are drawn
};

std::vector<SomeBody> Bodies() {
  return {
      {PaperBody({}), 0.8}, {FittedBody(PlainRestBody()).value(), 0.1}, {FittedBody(JointedRestBody()).value(), 0.1}};
}

IkProblem ProblemOf(const CaptureBody& body, const TreeState& truth) {
  LimbObservation seen{.ends = ToBodyPose(body, truth), .directions = {}};
  for (const Role limb : ObservedLimbs()) seen.directions[Index(limb)] = seen.ends[limb] - seen.ends[*ParentOf(limb)];
  return MakeImageProblem(body, seen, truth);
}

double LargestTurn(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(std::remainder(a[i] - b[i], 2 * kPi)));
  return largest;
}

class EveryStarter : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryStarter, ReturnsAStartThatHasNoError) {
  for (const SomeBody& some : Bodies()) {
    for (const std::string& weights : WeightRuleNames()) {
      for (int trial = 0; trial < 3; ++trial) {
        const TreeState truth = RandomPose(some.body.tree, trial, some.share);
        IkOptions options{.weights = *FindWeightRule(weights)};
        const IkSolution solution =
            FindIkSolver(GetParam())->solve(some.body.tree, ProblemOf(some.body, truth), options);
        EXPECT_EQ(solution.status, IkStatus::kConverged);
        EXPECT_EQ(solution.iterations, 0);
        EXPECT_LT(LargestTurn(solution.angles, truth.angles), 1e-12) << weights << " " << trial;
      }
    }
  }
}

// The control: a wrong start is moved, and gets nearer to the targets for every body.
TEST_P(EveryStarter, MovesOneThatIsOff) {
  for (const SomeBody& some : Bodies()) {
    const TreeState truth = RandomPose(some.body.tree, 1, some.share);
    IkProblem problem = ProblemOf(some.body, truth);
    for (std::size_t i = 0; i < problem.start.angles.size(); ++i) {
      const AngleRange& range = problem.limits[i];
      problem.start.angles[i] =
          std::clamp(truth.angles[i] + 0.03 * std::sin(7.0 * static_cast<double>(i)), range.lower, range.upper);
    }
    if (!FindIkSolver(GetParam())->uses_axes) {
      for (EffectorTarget& target : problem.targets) target.axis_weights = glm::dvec3(0);
    }
    IkOptions options{.weights = WeightRule::kAdaptivePower};
    const IkSolution solution = FindIkSolver(GetParam())->solve(some.body.tree, problem, options);
    std::vector<EffectorError> before;
    const TreeFrames frames = ComputeFrames(some.body.tree, problem.start);
    for (std::size_t e = 0; e < problem.targets.size(); ++e) {
      before.push_back(ErrorOf(frames.effectors[e], problem.targets[e]));
    }
    EXPECT_GT(solution.iterations, 0);
    EXPECT_LT(FindWorst(solution.errors, problem.targets).position, FindWorst(before, problem.targets).position);
  }
}

INSTANTIATE_TEST_SUITE_P(PerfectStart, EveryStarter, ::testing::ValuesIn(IkSolverNames()), [](const auto& solver) {
  std::string name = solver.param;
  std::ranges::replace(name, '-', '_');
  return name;
});

}  // namespace
}  // namespace etude
