#include "bench/tasks/ik/ik_task.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/metrics/catalogue.h"
#include "bench/tasks/ik/ik_world.h"

namespace etude {
namespace {

using testing::HasSubstr;

constexpr char kMethods[] = R"(
- {name: fixed, solver: ccd, weights: fixed}
- {name: adaptive, solver: ccd-hinges, weights: adaptive-power}
- {name: today, solver: damped-least-squares}
)";

Result<std::unique_ptr<Task>> Make(const std::string& condition, const std::string& methods = kMethods) {
  const Node condition_node = *ParseYaml(condition, "test.yaml");
  const Node method_node = *ParseYaml(methods, "methods.yaml");
  Fields fields(condition_node, "an ik scenario");
  const ClipLibrary no_clips;
  TaskInput input{fields, method_node.items, no_clips};
  return MakeIkTaskKind().make(input);
}

std::string ComplaintOf(const std::string& condition, const std::string& methods = kMethods) {
  const auto task = Make(condition, methods);
  return task ? "" : ToString(task.error());
}

double Metric(const CellResult& cell, const std::string& id) {
  for (const MetricValue& metric : cell.metrics) {
    if (metric.id == id) return metric.value.value();
  }
  ADD_FAILURE() << "no metric " << id;
  return 0;
}

const WorldKey kWorld{.suite_seed = 1, .scenario = "test", .trial = 0};

/// The cells of three methods in one world.
std::vector<CellResult> CellsOf(const Task& task) { return RunWorld(task, kWorld, 3); }

TEST(IkTask, GivesEveryMethodACellWithAllMetrics) {
  const auto task = Make("{joint_noise_deg: 15, max_sweeps: 300}");
  ASSERT_TRUE(task) << ToString(task.error());
  const std::vector<CellResult> cells = CellsOf(**task);
  ASSERT_EQ(cells.size(), 3u);
  for (const CellResult& cell : cells) {
    EXPECT_EQ(cell.metrics.size(), 12u);
    for (const MetricValue& metric : cell.metrics) EXPECT_NE(FindMetric(metric.id), nullptr) << metric.id;
    EXPECT_FALSE(cell.recording);
    ASSERT_EQ(cell.series.size(), 2u);
    EXPECT_LE(cell.series[0].values.size(), 200u);
    // The first cell of every curve is the start, which is the same for all methods.
    EXPECT_EQ(cell.series[0].values[0], cells[0].series[0].values[0]);
    EXPECT_EQ(cell.digests[0], cells[0].digests[0]) << "one world";
  }
  EXPECT_NE(cells[0].digests[1], cells[1].digests[1]);
}

TEST(IkTask, CallsACellUnsolvedWithItsErrorsWhenAnEffectorIsNotHome) {
  const auto task = Make("{joint_noise_deg: 15, max_sweeps: 300}");
  const std::vector<CellResult> cells = CellsOf(**task);
  const CellResult& fixed = cells[0];
  EXPECT_EQ(fixed.status, Status::kUnsolved);
  EXPECT_THAT(fixed.reason, HasSubstr("worst effector"));
  EXPECT_THAT(fixed.reason, HasSubstr("after 300 sweeps"));
  EXPECT_EQ(Metric(fixed, "solved_practical"), 0);
  EXPECT_GT(Metric(fixed, "orientation_error_deg"), 0.1);
  const CellResult& today = cells[2];
  EXPECT_EQ(today.status, Status::kOk);
  EXPECT_EQ(today.reason, "");
  EXPECT_EQ(Metric(today, "solved_practical"), 1);
  EXPECT_LT(Metric(today, "position_error_max_cm"), 0.1);
}

TEST(IkTask, RepeatsItselfToTheLastBit) {
  const auto digests = [](const WorldKey& key) {
    std::vector<std::pair<std::string, std::string>> all;
    for (const CellResult& cell : RunWorld(**Make("{max_sweeps: 20}"), key, 3)) {
      all.insert(all.end(), cell.digests.begin(), cell.digests.end());
    }
    return all;
  };
  EXPECT_EQ(digests(kWorld), digests(kWorld));
  EXPECT_NE(digests(kWorld), digests({.suite_seed = 1, .scenario = "test", .trial = 1}));
}

TEST(IkTask, MeasuresTightSolutionsWhenAskedToGoOn) {
  // A method that creeps up to its goal, so that where it stops is seen.
  const std::string one_method = "[{name: slow, solver: ccd-hinges, weights: adaptive-power}]";
  const std::string near = "joint_noise_deg: 2, max_sweeps: 3000";
  const CellResult practical = RunWorld(**Make("{stop_at: practical, " + near + "}", one_method), kWorld, 1)[0];
  const CellResult tight = RunWorld(**Make("{stop_at: tight, " + near + "}", one_method), kWorld, 1)[0];
  EXPECT_EQ(Metric(practical, "solved_tight"), 0);
  EXPECT_EQ(Metric(tight, "solved_tight"), 1);
  EXPECT_GT(Metric(tight, "iterations"), Metric(practical, "iterations"));
}

TEST(IkTask, KeepsHiddenAnglesWithinTheToleranceOfAMethod) {
  const std::string methods = R"(
- {name: free, weights: adaptive}
- {name: bound, weights: adaptive, tolerance_deg: 2}
- {name: same-bound, weights: adaptive, tolerance_times_noise: 0.2}
)";
  const auto cells = CellsOf(**Make("{joint_noise_deg: 10, max_sweeps: 50}", methods));
  EXPECT_LE(Metric(cells[1], "hidden_angle_change_deg"), 2);
  EXPECT_GT(Metric(cells[0], "hidden_angle_change_deg"), 2);
  EXPECT_EQ(Metric(cells[1], "hidden_angle_change_deg"), Metric(cells[2], "hidden_angle_change_deg"));
}

TEST(IkTask, RecordsTruthStartAndEveryIteration) {
  const auto task = Make("{max_sweeps: 5}", "[{name: fixed, weights: fixed}]");
  const CellResult cell = (*task)->MakeWorld(kWorld, true)->Run(0);
  ASSERT_TRUE(cell.recording);
  ASSERT_EQ(cell.recording->tracks.size(), 3u);
  for (const Track& track : cell.recording->tracks) EXPECT_EQ(track.motion.poses.size(), 6u) << track.name;
  const Role head = Role::kHead;
  const auto pose = [&](int track, int frame) { return cell.recording->tracks[track].motion.poses[frame][head]; };
  EXPECT_EQ(pose(2, 0), pose(1, 0)) << "the solution begins at the start";
  EXPECT_LT(glm::distance(pose(2, 5), pose(0, 5)), glm::distance(pose(1, 5), pose(0, 5))) << "and nears the truth";
}

TEST(IkTask, RefusesWhatItDoesNotKnowAndSaysWhereItStands) {
  EXPECT_THAT(ComplaintOf("{joint_noise_deg: -3}"), HasSubstr("test.yaml:1:19"));
  EXPECT_THAT(ComplaintOf("{poses: {unifrom: 0.5}}"), HasSubstr("uniform"));
  EXPECT_THAT(ComplaintOf("{poses: {uniform: 2}}"), HasSubstr("0 to 1"));
  EXPECT_THAT(ComplaintOf("{noise: pink}"), HasSubstr("gaussian"));
  EXPECT_THAT(ComplaintOf("{}", "[{name: a, solver: cdc}]"), HasSubstr("did you mean 'ccd'"));
  EXPECT_THAT(ComplaintOf("{}", "[{name: a, weights: adaptiv}]"), HasSubstr("did you mean 'adaptive'"));
  EXPECT_THAT(ComplaintOf("{}", "[{name: a, wieghts: fixed}]"), HasSubstr("weights"));
  EXPECT_THAT(ComplaintOf("{}", "[{name: a, solver: damped-least-squares, weights: fixed}]"), HasSubstr("has no"));
  EXPECT_THAT(ComplaintOf("{}", "[{name: a, tolerance_deg: 1, tolerance_times_noise: 1}]"), HasSubstr("either"));
  EXPECT_EQ(ComplaintOf("{poses: 0.7, noise: uniform, joint_noise_deg: 25, stop_at: tight}"), "");
}

TEST(IkWorld, ASweepChangesStrengthsAndNotTheDice) {
  const KinematicTree tree = MakeBodyTree({});
  const auto world = [&](double noise_deg, double range) {
    IkTrialOptions options;
    options.pose_range = range;
    options.joint_noise_deg = noise_deg;
    return MakeIkWorld(tree, options, kWorld);
  };
  const IkWorld weak = world(1, 0.5), strong = world(4, 0.5), wide = world(1, 1.0);
  EXPECT_EQ(weak.truth.angles, strong.truth.angles);
  int unclipped = 0;
  for (std::size_t i = 0; i < tree.limits.size(); ++i) {
    const double middle = 0.5 * (tree.limits[i].lower + tree.limits[i].upper);
    EXPECT_NEAR(wide.truth.angles[i] - middle, 2 * (weak.truth.angles[i] - middle), 1e-12);
    const double start = strong.problem.start.angles[i];
    if (start == tree.limits[i].lower || start == tree.limits[i].upper) continue;
    EXPECT_NEAR(start - strong.truth.angles[i], 4 * (weak.problem.start.angles[i] - weak.truth.angles[i]), 1e-12);
    ++unclipped;
  }
  EXPECT_GT(unclipped, 20);
}

TEST(IkWorld, TargetsAreWhatTheTrueAnglesGive) {
  const KinematicTree tree = MakeBodyTree({});
  const IkWorld world = MakeIkWorld(tree, {}, kWorld);
  const TreeFrames frames = ComputeFrames(tree, world.truth);
  for (std::size_t e = 0; e < 4; ++e) EXPECT_EQ(world.problem.targets[e].position, frames.effectors[e].position);
}

// Table 5.1(a): uniform noise of ±25° puts the ends 29–67 cm off and their axes 10–55°.
TEST(IkWorld, UniformNoiseOf25DegreesDisturbsAsMuchAsPaperBsTable) {
  const KinematicTree tree = MakeBodyTree({});
  IkTrialOptions options;
  options.noise = NoiseKind::kUniform;
  options.joint_noise_deg = 25;
  double position = 0, axis = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    const IkWorld world = MakeIkWorld(tree, options, {.suite_seed = 1, .scenario = "table", .trial = trial});
    const TreeFrames start = ComputeFrames(tree, world.problem.start);
    for (std::size_t e = 0; e < 4; ++e) {
      const EffectorError error = ErrorOf(start.effectors[e], world.problem.targets[e]);
      position += error.position / (4 * kTrials);
      axis += error.MeanAxisAngle(glm::dvec3(1)) / (4 * kTrials);
    }
  }
  EXPECT_GT(position, 0.29);
  EXPECT_LT(position, 0.67);
  EXPECT_GT(axis, Radians(10));
  EXPECT_LT(axis, Radians(55));
}

}  // namespace
}  // namespace etude
