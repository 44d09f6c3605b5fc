#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/metrics/catalogue.h"
#include "bench/tasks/base/task_kinds.h"
#include "tests/bench/tasks/base/cell_values.h"
#include "tests/bench/tasks/base/make_task.h"
#include "tests/support/results.h"
#include "tests/support/run_world.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

constexpr char kMethods[] = R"(
- {name: fixed, solver: ccd, weights: fixed}
- {name: adaptive, solver: ccd-hinges, weights: adaptive-power}
- {name: today, solver: damped-least-squares}
)";

Result<std::unique_ptr<Task>> Make(const std::string& condition, const std::string& methods = kMethods) {
  return MakeTask(MakeIkTaskKind(), condition, methods);
}

double Metric(const CellResult& cell, const std::string& id) { return ValueOf(cell, id).value(); }

const WorldKey kWorld{.suite_seed = 1, .scenario = "test", .trial = 0};

std::vector<CellResult> CellsOf(const Task& task) { return RunWorld(task, kWorld, 3); }

TEST(IkTask, GivesEveryMethodACellWithAllMetrics) {
  ASSERT_OK(task, Make("{joint_noise_deg: 15, max_sweeps: 300}"));
  const std::vector<CellResult> cells = CellsOf(**task);
  ASSERT_EQ(cells.size(), 3u);
  for (const CellResult& cell : cells) {
    EXPECT_EQ(cell.metrics.size(), 13u);
    for (const MetricValue& metric : cell.metrics) EXPECT_NE(FindMetric(metric.id), nullptr) << metric.id;
    EXPECT_FALSE(cell.recording);
    ASSERT_EQ(cell.series.size(), 2u);
    EXPECT_LE(cell.series[0].values.size(), 200u);
    // Every curve begins with the start pose's error, which is the same for all methods.
    EXPECT_EQ(cell.series[0].values[0], cells[0].series[0].values[0]);
    EXPECT_EQ(cell.digests[0], cells[0].digests[0]) << "one world";
  }
  EXPECT_NE(cells[0].digests[1], cells[1].digests[1]);
}

TEST(IkTask, CallsACellUnsolvedWhenAnEffectorIsNotHome) {
  const auto task = Make("{joint_noise_deg: 15, max_sweeps: 300}");
  const std::vector<CellResult> cells = CellsOf(**task);
  const CellResult& fixed = cells[0];
  EXPECT_EQ(fixed.status, Status::kUnsolved);
  EXPECT_EQ(fixed.reason, "stopped at the limit of 300 sweeps");
  EXPECT_EQ(Metric(fixed, "solved_practical"), 0);
  EXPECT_GT(Metric(fixed, "orientation_error_deg"), 0.1);
  const CellResult& today = cells[2];
  EXPECT_EQ(today.status, Status::kOk);
  EXPECT_EQ(today.reason, "");
  EXPECT_EQ(Metric(today, "solved_practical"), 1);
  EXPECT_LT(Metric(today, "position_error_max_cm"), 0.1);
}

TEST(IkTask, MeasuresTheSameWhetherItsMotionIsKeptOrNot) {
  // The solver iterates more often than a curve has values (kMaxCurveEntries). Only for a film, the task keeps the
  // whole trace.
  const auto task = Make("{max_sweeps: 300, record: [effector_curves]}");
  const std::vector<CellResult> kept = RunWorld(**task, kWorld, 3, true), cells = RunWorld(**task, kWorld, 3, false);
  for (std::size_t m = 0; m < cells.size(); ++m) {
    ASSERT_TRUE(kept[m].recording);
    EXPECT_FALSE(cells[m].recording);
    EXPECT_EQ(cells[m].digests, kept[m].digests);
    for (const char* id : {"iterations", "fk_evaluations", "orientation_error_deg", "position_error_cm"}) {
      EXPECT_EQ(Metric(cells[m], id), Metric(kept[m], id)) << id;
    }
    ASSERT_EQ(cells[m].series.size(), 2u + 16);
    for (std::size_t i = 0; i < cells[m].series.size(); ++i) {
      EXPECT_EQ(cells[m].series[i].values, kept[m].series[i].values) << cells[m].series[i].name;
    }
  }
  EXPECT_EQ(cells[0].series[0].values.size(), 200u);
  EXPECT_THAT(kept[0].recording->extras_json, HasSubstr(",300]")) << "the last iteration is shown";
}

TEST(IkTask, RepeatsItselfToTheLastBit) {
  const auto task = Make("{max_sweeps: 20}"), anew = Make("{max_sweeps: 20}");
  const auto once = RunWorld(**task, kWorld, 3), again = RunWorld(**anew, kWorld, 3);
  for (std::size_t m = 0; m < 3; ++m) EXPECT_EQ(once[m].digests, again[m].digests);
  EXPECT_NE(RunWorld(**task, {.suite_seed = 1, .scenario = "test", .trial = 1}, 1)[0].digests, once[0].digests);
}

TEST(IkTask, MeasuresTightSolutionsWhenAskedToGoOn) {
  // A slowly converging method, so that the iteration at which it stops is visible.
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
- {name: free, solver: ccd, weights: adaptive}
- {name: bound, solver: ccd, weights: adaptive, tolerance_deg: 2}
- {name: same-bound, solver: ccd, weights: adaptive, tolerance_times_noise: 0.2}
)";
  const auto cells = CellsOf(**Make("{joint_noise_deg: 10, max_sweeps: 50}", methods));
  EXPECT_LE(Metric(cells[1], "hidden_angle_change_deg"), 2);
  EXPECT_GT(Metric(cells[0], "hidden_angle_change_deg"), 2);
  EXPECT_EQ(Metric(cells[1], "hidden_angle_change_deg"), Metric(cells[2], "hidden_angle_change_deg"));
}

TEST(IkTask, KeepsTheSeriesThatAScenarioAsksFor) {
  const auto names = [](const std::string& condition) {
    std::vector<std::string> all;
    const auto task = Make(condition, "[{name: a, solver: ccd, weights: fixed}]");
    const CellResult cell = RunWorld(**task, kWorld, 1)[0];
    for (const Series& series : cell.series) all.push_back(series.name);
    return all;
  };
  EXPECT_THAT(names("{}"), ::testing::ElementsAre("position_error_max_cm", "orientation_error_max_deg"));
  EXPECT_EQ(names("{record: [effector_errors, angle_changes, effector_curves]}").size(), 2u + 12 + 2 + 16);
  EXPECT_THAT(names("{record: [angle_changes]}"), ::testing::Contains("angle_error_deg"));
}

TEST(IkTask, JudgesOnlyWhatIsAskedFor) {
  const std::string one_method = "[{name: today, solver: damped-least-squares}]";
  const CellResult both = RunWorld(**Make("{}", one_method), kWorld, 1)[0];
  EXPECT_LT(Metric(both, "orientation_error_max_deg"), 0.1) << "a control";
  const CellResult position = RunWorld(**Make("{targets: position}", one_method), kWorld, 1)[0];
  EXPECT_EQ(position.status, Status::kOk) << position.reason;
  EXPECT_EQ(Metric(position, "solved_practical"), 1);
  EXPECT_LT(Metric(position, "position_error_max_cm"), 0.1);
  EXPECT_GT(Metric(position, "orientation_error_max_deg"), 0.1) << "measured, but nobody asked for it";
  const CellResult orientation = RunWorld(**Make("{targets: orientation}", one_method), kWorld, 1)[0];
  EXPECT_EQ(orientation.status, Status::kOk) << orientation.reason;
  EXPECT_LT(Metric(orientation, "orientation_error_max_deg"), 0.1);
  EXPECT_GT(Metric(orientation, "position_error_max_cm"), 0.1);
}

TEST(IkTask, TellsWhyACellStopped) {
  const auto reason = [](const std::string& condition, const std::string& method) {
    return RunWorld(**Make(condition, "[{name: a, " + method + "}]"), kWorld, 1)[0].reason;
  };
  EXPECT_EQ(reason("{max_sweeps: 7}", "solver: ccd, weights: fixed"), "stopped at the limit of 7 sweeps");
  EXPECT_EQ(reason("{unreachable_cm: 5}", "solver: damped-least-squares"), "a target is out of reach");
  EXPECT_EQ(reason("{start: stretched}", "solver: damped-least-squares"), "stalled before the targets were met");
  EXPECT_THAT(reason("{}", "solver: fabrik"), HasSubstr("uses only positions"));
  EXPECT_EQ(reason("{targets: position}", "solver: fabrik"), "") << "solved, where positions are all that is asked for";
}

TEST(IkTask, CountsBrokenLimitsOfAMethodThatIgnoresThem) {
  const std::string methods =
      "[{name: kept, solver: ccd, weights: fixed-tuned}, {name: free, solver: ccd, weights: fixed-tuned, limits: "
      "false}]";
  const auto cells = RunWorld(**Make("{poses: 1, joint_noise_deg: 40}", methods), kWorld, 2);
  EXPECT_EQ(Metric(cells[0], "limit_violations"), 0);
  EXPECT_GT(Metric(cells[1], "limit_violations"), 0);
  EXPECT_EQ(Metric(cells[1], "solved_practical"), 0);
}

}  // namespace
}  // namespace etude
