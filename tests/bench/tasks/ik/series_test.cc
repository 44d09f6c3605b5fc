#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bench/tasks/ik/exchange.h"
#include "bench/tasks/ik/run.h"
#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/ik_solver.h"

namespace etude {
namespace {


struct FixedRun {
  KinematicTree tree = MakeBodyTree({});
  IkWorld world = MakeIkWorld(tree, {}, {.suite_seed = 1, .scenario = "series", .trial = 0});
  IkSolution solution;

  explicit FixedRun(int iterations) {
    IkOptions options;
    options.weights = WeightRule::kFixed;  // never met
    options.trace = true;
    options.max_iterations = iterations;
    solution = FindIkSolver("ccd")->solve(tree, world.problem, options);
  }
};

const Series& Named(const std::vector<Series>& all, const std::string& name) {
  const auto found = std::ranges::find(all, name, &Series::name);
  EXPECT_NE(found, all.end()) << name;
  return found == all.end() ? all.front() : *found;
}

/// A second computation of the errors of `angles`.
struct SecondErrors {
  std::vector<glm::dvec3> position_cm, axis_deg;

  SecondErrors(const FixedRun& run, const std::vector<double>& angles) {
    TreeState state = run.world.problem.start;
    state.angles = angles;
    const TreeFrames frames = ComputeFrames(run.tree, state), wanted = ComputeFrames(run.tree, run.world.truth);
    for (std::size_t e = 0; e < frames.effectors.size(); ++e) {
      position_cm.push_back(100.0 * (frames.effectors[e].position - wanted.effectors[e].position));
      glm::dvec3 angle;
      for (int k = 0; k < 3; ++k) {
        angle[k] = Degrees(std::acos(glm::dot(frames.effectors[e].axes[k], wanted.effectors[e].axes[k])));
      }
      axis_deg.push_back(angle);
    }
  }
};

TEST(IkSeries, EffectorErrorsAreWhatForwardKinematicsGives) {
  const FixedRun run(30);
  const auto all = EffectorErrors(run.tree, run.world.problem, run.solution.angles);
  ASSERT_EQ(all.size(), 12u);
  const SecondErrors before(run, run.world.problem.start.angles), after(run, run.solution.angles);
  const std::string axes[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    for (std::size_t e = 0; e < 4; ++e) {
      EXPECT_NEAR(Named(all, "start_position_error_" + axes[k] + "_cm").values[e], before.position_cm[e][k], 1e-9);
      EXPECT_NEAR(Named(all, "position_error_" + axes[k] + "_cm").values[e], after.position_cm[e][k], 1e-9);
      EXPECT_NEAR(Named(all, "start_orientation_error_" + axes[k] + "_deg").values[e], before.axis_deg[e][k], 1e-6);
      EXPECT_NEAR(Named(all, "orientation_error_" + axes[k] + "_deg").values[e], after.axis_deg[e][k], 1e-6);
    }
  }
  EXPECT_NE(before.position_cm[0], after.position_cm[0]) << "a control";
}

TEST(IkSeries, AngleChangesAreSignedDegrees) {
  const FixedRun run(30);
  const auto all = AngleChanges(run.world, run.solution.angles);
  for (std::size_t i = 0; i < 29; ++i) {
    const double change = Named(all, "angle_change_deg").values[i], error = Named(all, "angle_error_deg").values[i];
    EXPECT_NEAR(run.world.problem.start.angles[i] + Radians(change), run.solution.angles[i], 1e-12);
    EXPECT_NEAR(run.world.truth.angles[i] + Radians(error), run.solution.angles[i], 1e-12);
  }
}

TEST(IkSeries, CurvesOfEveryEffectorGoFromTheStartToTheEndAndTheirWorstIsTheWorstCurve) {
  const FixedRun run(30);
  const auto curves = EffectorCurves(run.tree, run.solution.trace), worst = WorstErrorCurves(run.solution.trace);
  ASSERT_EQ(curves.size(), 16u);
  const SecondErrors before(run, run.world.problem.start.angles), after(run, run.solution.angles);
  const std::string axes[] = {"x", "y", "z"};
  for (std::size_t e = 0; e < 4; ++e) {
    const std::string name(run.tree.effectors[e].name);
    const Series position = Named(curves, name + "_position_error_cm");
    ASSERT_EQ(position.values.size(), 31u);
    EXPECT_NEAR(position.values.front(), glm::length(before.position_cm[e]), 1e-9);
    EXPECT_NEAR(position.values.back(), glm::length(after.position_cm[e]), 1e-9);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(Named(curves, name + "_" + axes[k] + "_axis_error_deg").values.back(), after.axis_deg[e][k], 1e-6);
    }
  }
  for (std::size_t i = 0; i < 31; ++i) {
    double longest = 0;
    for (std::size_t e = 0; e < 4; ++e) longest = std::max(longest, curves[4 * e].values[i]);
    EXPECT_DOUBLE_EQ(worst[0].values[i], longest);
  }
  EXPECT_EQ(WorstErrorCurves(FixedRun(300).solution.trace)[0].values.size(), 200u);
}

TEST(IkRecording, ShowsEveryIterationUpToSixtyThenGrowingStepsAndTheLast) {
  EXPECT_THAT(RecordedIterations(0), ::testing::ElementsAre(0));
  EXPECT_THAT(RecordedIterations(2), ::testing::ElementsAre(0, 1, 2));
  for (const int last : {59, 60, 61, 149, 150, 151, 200, 1000, 3000, 100'000, 100'000'000}) {
    const std::vector<int> shown = RecordedIterations(last);
    EXPECT_LE(shown.size(), 150u) << last;
    EXPECT_EQ(shown.back(), last);
    for (int i = 0; i <= std::min(last, 60); ++i) EXPECT_EQ(shown[static_cast<std::size_t>(i)], i) << last;
    for (std::size_t i = 1; i < shown.size(); ++i) EXPECT_GT(shown[i], shown[i - 1]) << last;
    // Steps never shrink, except the last one, which ends where the solver ended.
    for (std::size_t i = 2; i + 1 < shown.size(); ++i) {
      EXPECT_GE(shown[i] - shown[i - 1], shown[i - 1] - shown[i - 2]) << last;
    }
  }
  EXPECT_EQ(RecordedIterations(149).size(), 150u) << "no frame is left out without need";
}

TEST(IkRecording, HoldsTruthStartAndTheSolutionFrameByFrameWithItsErrors) {
  const FixedRun run(300);
  const Recording recording = RecordIk(run.tree, run.world, StepsOf(run.solution.trace));
  const Json extras = Json::parse(recording.extras_json);
  ASSERT_EQ(recording.tracks.size(), 3u);
  for (const Track& track : recording.tracks) EXPECT_EQ(track.motion.poses.size(), extras["iterations"].size());
  EXPECT_EQ(extras["iterations"].back(), 300);
  const auto pose = [&](int track, std::size_t frame) { return recording.tracks[track].motion.poses[frame]; };
  EXPECT_EQ(pose(2, 0).joints, pose(1, 0).joints) << "the solution begins at the start";
  for (std::size_t e = 0; e < run.world.problem.targets.size(); ++e) {
    const glm::dvec3& at = run.world.problem.targets[e].position;
    EXPECT_EQ(extras["targets_m"][e], Json({at.x, at.y, at.z}));
  }
  // The picture shows the head at the same distance from its target as the solver's trace states.
  for (std::size_t i = 0; i < extras["iterations"].size(); ++i) {
    const auto& entry = run.solution.trace[extras["iterations"][i].get<std::size_t>()];
    EXPECT_NEAR(glm::distance(pose(2, i)[Role::kHead], pose(0, i)[Role::kHead]), entry.errors[3].position, 1e-9);
    EXPECT_EQ(extras["position_error_max_cm"][i].get<double>(), 100 * entry.worst_position);
    EXPECT_EQ(extras["orientation_error_max_deg"][i].get<double>(), Degrees(entry.worst_mean_axis));
    EXPECT_EQ(extras["axis_error_max_deg"][i].get<double>(), Degrees(entry.worst_axis));
  }
}

}  // namespace
}  // namespace etude
