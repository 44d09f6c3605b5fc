#include "engine/kinematics/solvers/ik_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/kinematics/body_tree.h"
#include "tests/engine/kinematics/posed_tree.h"

namespace etude {
namespace {

struct Trial {
  KinematicTree tree = MakeBodyTree({});
  IkProblem problem = DisturbedProblem(tree, RandomPose(tree, 1, 0.5), 1, 15);
  IkOptions options;
};

// Returns equal errors for all effectors, metres and radians.
std::vector<EffectorError> ErrorsOf(double position, double axis) {
  return std::vector<EffectorError>(4, {position, glm::dvec3(axis)});
}

TEST(IkRun, CountsTheStartAsNoIteration) {
  const Trial trial;
  IkRun run(trial.tree, trial.problem, trial.options);
  run.Record(ErrorsOf(0.5, 0.5), run.start_angles());
  EXPECT_EQ(run.iterations(), 0);
  run.Record(ErrorsOf(0.4, 0.5), run.start_angles(), 3);
  const IkSolution solution = run.Finish(run.start_angles());
  EXPECT_EQ(solution.iterations, 1);
  EXPECT_EQ(solution.fk_evaluations, 4);
  EXPECT_EQ(solution.errors[2].position, 0.4);
}

TEST(IkRun, GoesOnUntilBothGoalsAreReached) {
  const Trial trial;
  IkRun run(trial.tree, trial.problem, trial.options);
  run.Record(ErrorsOf(0.5, 0.5), run.start_angles());
  EXPECT_TRUE(run.MustGoOn());
  run.Record(ErrorsOf(1e-4, 0.5), run.start_angles());
  EXPECT_TRUE(run.MustGoOn()) << "the axes are off";
  run.Record(ErrorsOf(1e-4, 1e-4), run.start_angles());
  EXPECT_FALSE(run.MustGoOn());
  EXPECT_EQ(run.Finish(run.start_angles()).status, IkStatus::kConverged);
}

TEST(IkRun, GoesOnWhileOneAxisIsOffAndTracesTheMeanToo) {
  Trial trial;
  trial.options.trace = true;
  IkRun run(trial.tree, trial.problem, trial.options);
  std::vector<EffectorError> errors = ErrorsOf(1e-4, Radians(0.08));
  errors[1].axis_angles = {Radians(0.12), Radians(0.12), 0};
  run.Record(errors, run.start_angles());
  EXPECT_TRUE(run.MustGoOn());
  errors[1].axis_angles = {Radians(0.09), Radians(0.09), 0};
  run.Record(errors, run.start_angles());
  EXPECT_FALSE(run.MustGoOn());
  const IkSolution solution = run.Finish(run.start_angles());
  EXPECT_EQ(solution.trace[0].worst_axis, Radians(0.12));
  EXPECT_NEAR(solution.trace[0].worst_mean_axis, Radians(0.08), 1e-15);
  EXPECT_EQ(solution.trace[1].worst_axis, Radians(0.09));
}

// One limb is twisted about its axis: two of its frame's axes move, one stays.
TEST(IkRun, SeesATwistedLimbByItsFramesToo) {
  const Trial trial;
  TreeState truth = RandomPose(trial.tree, 1, 0.5);
  const IkProblem problem = DisturbedProblem(trial.tree, truth, 1, 0);
  for (const auto& [degrees, is_met] : {std::pair(0.099, true), std::pair(0.101, false), std::pair(0.149, false)}) {
    TreeFrames frames = ComputeFrames(trial.tree, truth);
    glm::dmat3& R_WE = frames.effectors[2].axes;
    const double c = std::cos(Radians(degrees)), s = std::sin(Radians(degrees));
    R_WE = R_WE * glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1);
    IkRun run(trial.tree, problem, trial.options);
    run.RecordFrames(frames, truth.angles);
    EXPECT_EQ(run.HasConverged(), is_met) << degrees;
  }
}

TEST(IkRun, TellsAStallFromAnExhaustedBudget) {
  Trial trial;
  trial.options.max_iterations = 1;
  IkRun spent(trial.tree, trial.problem, trial.options);
  spent.Record(ErrorsOf(0.5, 0.5), spent.start_angles());
  spent.Record(ErrorsOf(0.5, 0.5), spent.start_angles());
  EXPECT_FALSE(spent.MustGoOn());
  EXPECT_EQ(spent.Finish({}).status, IkStatus::kIterationLimit);

  IkRun stalled(trial.tree, trial.problem, trial.options);
  stalled.Record(ErrorsOf(0.5, 0.5), stalled.start_angles());
  stalled.Stall();
  EXPECT_FALSE(stalled.MustGoOn());
  EXPECT_EQ(stalled.Finish({}).status, IkStatus::kStalled);
}

TEST(IkRun, CallsAFailureUnreachableWhenNoPoseCouldReach) {
  Trial trial;
  trial.problem.targets[3].position += glm::dvec3(0, 5, 0);
  IkRun run(trial.tree, trial.problem, trial.options);
  run.Record(ErrorsOf(5, 0.5), run.start_angles());
  run.Stall();
  EXPECT_EQ(run.Finish({}).status, IkStatus::kUnreachable);
}

TEST(IkRun, MovesTheStartIntoItsRanges) {
  Trial trial;
  trial.problem.start.angles[4] = trial.problem.limits[4].upper + 1;
  EXPECT_EQ(IkRun(trial.tree, trial.problem, trial.options).start_angles()[4], trial.problem.limits[4].upper);
  trial.options.limits = false;
  EXPECT_EQ(IkRun(trial.tree, trial.problem, trial.options).start_angles()[4], trial.problem.limits[4].upper + 1);
}

TEST(IkRun, AsksForAnglesOnlyWhenTheyAreTraced) {
  Trial trial;
  int asked = 0;
  const auto angles = [&] {
    ++asked;
    return trial.problem.start.angles;
  };
  IkRun untraced(trial.tree, trial.problem, trial.options);
  untraced.Record(ErrorsOf(0.5, 0.5), angles);
  EXPECT_TRUE(untraced.Finish({}).trace.empty());
  EXPECT_EQ(asked, 0);

  trial.options.trace = true;
  IkRun traced(trial.tree, trial.problem, trial.options);
  traced.Record(ErrorsOf(0.5, 0.25), angles);
  const IkSolution solution = traced.Finish({});
  EXPECT_EQ(asked, 1);
  ASSERT_EQ(solution.trace.size(), 1u);
  EXPECT_EQ(solution.trace[0].angles, trial.problem.start.angles);
  EXPECT_EQ(solution.trace[0].worst_position, 0.5);
  EXPECT_EQ(solution.trace[0].worst_axis, 0.25);
  EXPECT_EQ(solution.trace[0].errors[3].position, 0.5);
}

TEST(IkRun, TracesNoMoreThanIsAskedFor) {
  Trial trial;
  trial.options.trace = true;
  trial.options.max_trace_entries = 2;
  IkRun run(trial.tree, trial.problem, trial.options);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(run.Traces(), i < 2);
    run.Record(ErrorsOf(0.5 - 0.1 * i, 0.5), run.start_angles());
  }
  const IkSolution solution = run.Finish(run.start_angles());
  ASSERT_EQ(solution.trace.size(), 2u);
  EXPECT_EQ(solution.trace[1].worst_position, 0.4);
  EXPECT_EQ(solution.iterations, 4);
}

TEST(IkRun, ComesToTheSameByFramesAsByErrors) {
  const Trial trial;
  TreeState truth = RandomPose(trial.tree, 1, 0.5);
  int near = 0, far = 0;
  for (const double off : {1e-1, 1e-2, 3e-3, 1e-3, 5e-4, 3e-4, 1e-4, 1e-5, 0.0}) {
    for (std::size_t d = 0; d < truth.angles.size(); ++d) {
      TreeState state = truth;
      state.angles[d] += off;
      const TreeFrames frames = ComputeFrames(trial.tree, state);
      std::vector<EffectorError> errors;
      MeasureErrors(frames, trial.problem.targets, errors);
      IkRun by_errors(trial.tree, trial.problem, trial.options), by_frames(trial.tree, trial.problem, trial.options);
      by_errors.Record(errors, state.angles);
      by_frames.RecordFrames(frames, state.angles);
      (by_errors.HasConverged() ? near : far) += 1;
      EXPECT_EQ(by_frames.HasConverged(), by_errors.HasConverged()) << off;
      const IkSolution a = by_errors.Finish(state.angles), b = by_frames.Finish(state.angles);
      EXPECT_EQ(a.status == IkStatus::kConverged, b.status == IkStatus::kConverged);
      for (std::size_t e = 0; e < errors.size(); ++e) {
        EXPECT_EQ(b.errors[e].position, a.errors[e].position);
        EXPECT_EQ(b.errors[e].axis_angles, a.errors[e].axis_angles);
      }
    }
  }
  EXPECT_GT(std::min(near, far), 20) << "else one side was not looked at";
}

TEST(Restarts, BeginAtOtherPosesAroundTheStartWithinTheRanges) {
  const std::vector<AngleRange>& ranges = Body().limits;
  std::vector<std::vector<double>> poses;
  for (int trial = 0; trial < 5; ++trial) {
    const std::vector<double> start = RandomPose(Body(), trial, 1.0).angles;
    for (int number = 1; number <= kRestarts; ++number) {
      std::vector<double>& angles = poses.emplace_back();
      ScatterAround(start, ranges, number, angles);
      for (std::size_t d = 0; d < angles.size(); ++d) {
        EXPECT_TRUE(angles[d] >= ranges[d].lower && angles[d] <= ranges[d].upper);
        EXPECT_LE(std::abs(angles[d] - start[d]), 1.5);
      }
      std::vector<double> again;
      ScatterAround(start, ranges, number, again);
      EXPECT_EQ(again, angles) << "no dice";
    }
  }
  std::ranges::sort(poses);
  EXPECT_EQ(std::ranges::adjacent_find(poses), poses.end()) << "each is a try of its own";
}

// If no limit cuts the interval of 3 rad, each tenth of the interval gets a tenth of the restarts.
TEST(Restarts, AreSpreadEvenly) {
  const std::vector<AngleRange> wide(6, {-100, 100});
  const std::vector<double> start = {0, 0.3, -0.7, 1.1, 2, -2};
  constexpr int kNumbers = 500;
  for (std::size_t d = 0; d < start.size(); ++d) {
    int counts[10] = {};
    for (int number = 1; number <= kNumbers; ++number) {
      std::vector<double> angles;
      ScatterAround(start, wide, number, angles);
      ++counts[std::min(9, static_cast<int>((angles[d] - start[d] + 1.5) / 0.3))];
    }
    for (const int count : counts) EXPECT_NEAR(count, kNumbers / 10, 8) << d;
  }
}

}  // namespace
}  // namespace etude
