#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bench/metrics/catalogue.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/tracking/run.h"
#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "tests/bench/tasks/base/cell_values.h"
#include "tests/bench/tasks/base/make_task.h"
#include "tests/bench/tasks/tracking/some_clips.h"
#include "tests/support/results.h"
#include "tests/support/run_world.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const WorldKey kWorld{.suite_seed = 1, .scenario = "test", .trial = 0};

constexpr char kMethods[] = R"(
- {name: warm, solver: damped-least-squares}
- {name: cold, solver: damped-least-squares, start: cold}
- {name: sweeps, solver: ccd-hinges, weights: adaptive-power}
)";

Result<std::unique_ptr<Task>> Make(const std::string& condition, const std::string& methods = kMethods,
                                   const ClipLibrary& clips = {{BuiltinClipOf("builtin:clap")}}) {
  return MakeTask(MakeTrackingTaskKind(), condition, methods, clips);
}

const std::vector<double>& SeriesOf(const CellResult& cell, std::string_view name) {
  for (const Series& series : cell.series) {
    if (series.name == name) return series.values;
  }
  ADD_FAILURE() << "no series " << name;
  static const std::vector<double> none;
  return none;
}

TEST(TrackingTask, GivesEveryMethodACellWithAllMetricsAndSeriesAlongTheFrames) {
  ASSERT_OK(task, Make("{duration_s: 1}"));
  EXPECT_EQ((*task)->ClipsOf(kWorld).front(), "builtin:clap");
  const auto cells = RunWorld(**task, kWorld, 3);
  const TaskKind kind = MakeTrackingTaskKind();
  for (const CellResult& cell : cells) {
    ASSERT_EQ(cell.metrics.size(), kind.metrics.size());
    for (const std::string& id : kind.metrics) {
      EXPECT_TRUE(ValueOf(cell, id)) << id;
      EXPECT_NE(FindMetric(id), nullptr) << id;
    }
    EXPECT_EQ(cell.series.size(), 5u);
    for (const Series& series : cell.series) {
      EXPECT_EQ(series.axis, "frame");
      EXPECT_EQ(series.values.size(), 30u) << series.name;
    }
    EXPECT_EQ(cell.digests[0], cells[0].digests[0]) << "one world";
    EXPECT_FALSE(cell.recording);
  }
  EXPECT_NE(cells[0].digests[1], cells[1].digests[1]);
}

TEST(TrackingTask, StartingWarmTakesFewerStepsAndSolvesMore) {
  const auto cells = RunWorld(**Make("{duration_s: 1}"), kWorld, 2);
  const CellResult &warm = cells[0], &cold = cells[1];
  EXPECT_LT(*ValueOf(warm, "iterations_per_frame"), 0.5 * *ValueOf(cold, "iterations_per_frame"));
  EXPECT_GT(*ValueOf(warm, "frames_solved"), *ValueOf(cold, "frames_solved"));
  EXPECT_EQ(SeriesOf(warm, "mpjpe_mm")[0], SeriesOf(cold, "mpjpe_mm")[0]) << "the first frame starts alike";
  EXPECT_NE(SeriesOf(warm, "mpjpe_mm")[1], SeriesOf(cold, "mpjpe_mm")[1]);
}

TEST(TrackingTask, IsOkWhenEveryFrameIsSolvedAndElseSaysWhatIsNot) {
  const std::string method = "[{name: today, solver: damped-least-squares}]";
  const CellResult kept_up = RunWorld(**Make("{duration_s: 1, joint_noise_deg: 1}", method), kWorld, 1)[0];
  EXPECT_EQ(kept_up.status, Status::kOk) << kept_up.reason;
  EXPECT_EQ(ValueOf(kept_up, "frames_solved"), 1);
  const CellResult lost = RunWorld(**Make("{duration_s: 1, max_sweeps: 1}", method), kWorld, 1)[0];
  EXPECT_EQ(lost.status, Status::kUnsolved);
  EXPECT_THAT(lost.reason, HasSubstr("of 30 frames not solved; the first is frame 0, with errors of up to"));
  EXPECT_LT(*ValueOf(lost, "frames_solved"), 1);
}

TEST(TrackingTask, ATightGoalIsMetTightly) {
  const std::string method = "[{name: today, solver: damped-least-squares}]";
  const auto cell_of = [&](const std::string& goal) {
    return RunWorld(**Make("{duration_s: 1, joint_noise_deg: 1, stop_at: " + goal + "}", method), kWorld, 1)[0];
  };
  EXPECT_LT(*ValueOf(cell_of("practical"), "frames_solved_tight"), 1);
  EXPECT_EQ(*ValueOf(cell_of("tight"), "frames_solved_tight"), 1);
}

TEST(TrackingTask, NoiseInTheTargetsMakesTheAnglesJerkier) {
  const std::string method = "[{name: today, solver: damped-least-squares}]";
  const auto cell_of = [&](const std::string& noise) {
    return RunWorld(**Make("{duration_s: 1, joint_noise_deg: 0, target_noise_cm: " + noise + "}", method), kWorld,
                    1)[0];
  };
  const CellResult clean = cell_of("0"), noisy = cell_of("1");
  EXPECT_GT(*ValueOf(noisy, "angle_jerk_ratio"), 3 * *ValueOf(clean, "angle_jerk_ratio"));
  EXPECT_GT(*ValueOf(noisy, "mpjpe_mm"), *ValueOf(clean, "mpjpe_mm"));
}

TEST(TrackingTask, RepeatsItselfToTheLastBit) {
  const auto task = Make("{duration_s: 0.5, target_noise_cm: 1}"), anew = Make("{duration_s: 0.5, target_noise_cm: 1}");
  const auto once = RunWorld(**task, kWorld, 3), again = RunWorld(**anew, kWorld, 3);
  for (std::size_t m = 0; m < 3; ++m) EXPECT_EQ(once[m].digests, again[m].digests);
  EXPECT_NE(RunWorld(**task, {.suite_seed = 1, .scenario = "test", .trial = 1}, 1)[0].digests, once[0].digests);
}

TEST(TrackingTask, RecordsTruthAndSolutionAtTheRateOfItsFrames) {
  const auto task = Make("{duration_s: 1, rate_hz: 10}");
  const CellResult cell = (*task)->MakeWorld(kWorld, true)->Run(0);
  ASSERT_TRUE(cell.recording);
  ASSERT_EQ(cell.recording->tracks.size(), 2u);
  EXPECT_EQ(cell.recording->tracks[0].name, "truth");
  EXPECT_EQ(cell.recording->tracks[1].name, "solution");
  for (const Track& track : cell.recording->tracks) {
    EXPECT_EQ(track.motion.poses.size(), 10u);
    EXPECT_EQ(track.motion.rate_hz, 10);
  }
}

TEST(Follow, KeepsEveryFrameWithinTheToleranceOfTheOneBefore) {
  ASSERT_OK(world, MakeTrackingWorld({.duration_s = 1, .joint_noise_deg = 0}, BuiltinClipOf("builtin:clap"), kWorld));
  TrackingMethod method{.name = "bound", .solver = FindIkSolver("ccd-hinges"), .options = {}};
  const auto largest_step_deg = [&] {
    const auto answer = Follow(*world, method);
    double largest = 0;
    for (std::size_t k = 1; k < answer->angles.size(); ++k) {
      for (std::size_t i = 0; i < 29; ++i) {
        largest = std::max(largest, std::abs(answer->angles[k][i] - answer->angles[k - 1][i]));
      }
    }
    return Degrees(largest);
  };
  EXPECT_GT(largest_step_deg(), 3);
  method.options.angle_change_tolerance = Radians(3);
  EXPECT_LE(largest_step_deg(), 3 + 1e-9);
}

// Standing is far from the first pose of these clips, and a few steps may lead into a corner of the limits.
TEST(Follow, AMotionIsNotLostForGoodWhereStepsAreFew) {
  for (const char* clip : {"builtin:fast_sway", "builtin:side_stretch", "builtin:jump"}) {
    ASSERT_OK(world, MakeTrackingWorld({}, BuiltinClipOf(clip), kWorld));
    TrackingMethod method{.name = "few", .solver = FindIkSolver("gauss-newton"), .options = {}};
    for (const auto& [steps, at_least] : {std::pair(5, 0.8), {10, 0.9}, {20, 0.95}}) {
      method.options.max_iterations = steps;
      const CellResult cell = ScoreTracking(*world, kJudgedRateHz, *Follow(*world, method), false);
      EXPECT_GE(*ValueOf(cell, "frames_solved"), at_least) << clip << ", " << steps << " steps";
    }
  }
}

TEST(Follow, EveryColdFrameIsSolvedAsIfItWereTheFirst) {
  ASSERT_OK(whole, MakeTrackingWorld({.duration_s = 1}, BuiltinClipOf("builtin:clap"), kWorld));
  TrackingMethod method{
      .name = "cold", .solver = FindIkSolver("ccd-hinges"), .options = {}, .start = FrameStart::kCold};
  const auto all = Follow(*whole, method);
  TrackingWorld last = *whole;
  last.truth.assign(1, whole->truth.back());
  last.targets.assign(1, whole->targets.back());
  EXPECT_EQ(Follow(last, method)->angles.front(), all->angles.back());
  method.start = FrameStart::kWarm;
  EXPECT_NE(Follow(*whole, method)->angles.back(), all->angles.back()) << "a control";
}

TEST(TrackingTask, SkipsAClipThatIsTooShort) {
  const KinematicTree tree = MakeBodyTree({});
  ASSERT_OK(task, Make("{}", kMethods, {{ClipOf(tree, SwingingStates(tree, 2))}}));
  const CellResult cell = RunWorld(**task, kWorld, 3)[1];
  EXPECT_EQ(cell.status, Status::kSkipped);
  EXPECT_THAT(cell.reason, HasSubstr("tracking needs 4"));
}

}  // namespace
}  // namespace etude
