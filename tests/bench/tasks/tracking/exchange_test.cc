#include "bench/tasks/tracking/exchange.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/tracking/run.h"
#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "tests/bench/tasks/base/cell_values.h"
#include "tests/bench/tasks/base/exchange_checks.h"
#include "tests/bench/tasks/base/make_task.h"
#include "tests/bench/tasks/tracking/some_clips.h"
#include "tests/support/kept_answers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const WorldKey kTrackedWorld{.suite_seed = 1, .scenario = "exchange", .trial = 0};
constexpr double kRate = 30;

std::unique_ptr<Task> MakeTrackingTask(const std::string& condition = "{duration_s: 0.5}") {
  return *MakeTask(MakeTrackingTaskKind(), condition, "[]", {{BuiltinClipOf("builtin:boxing")}});
}

TEST(TrackingExchange, TellsTheBodyOnceAndEveryFramesRootAndTargets) {
  const auto task = MakeTrackingTask();
  const Json setting = *task->Setting()->json, problem = *task->MakeWorld(kTrackedWorld, false)->MakeProblem()->json;
  EXPECT_EQ(setting["rate_hz"], 30);
  EXPECT_EQ(setting["max_steps"], 20);
  EXPECT_EQ(problem["angles"].size(), 29u);
  EXPECT_EQ(problem["start_angles_deg"].size(), 29u);
  ASSERT_EQ(problem["frames"].size(), 15u);
  for (const Json& frame : problem["frames"]) {
    EXPECT_EQ(frame["root"]["position_m"].size(), 3u);
    ASSERT_EQ(frame["targets"].size(), 4u);
    for (std::size_t e = 0; e < 4; ++e) EXPECT_EQ(frame["targets"][e]["effector"], problem["effectors"][e]["name"]);
  }
  EXPECT_NE(problem["frames"][0]["targets"], problem["frames"][9]["targets"]);
}

TEST(TrackingExchange, TheTruthIsAPerfectAnswer) {
  const auto task = MakeTrackingTask();
  const auto world = task->MakeWorld(kTrackedWorld, true);
  ASSERT_OK(cell, world->Judge(*world->MakeTruth()->json));
  EXPECT_EQ(cell->status, Status::kOk) << cell->reason;
  EXPECT_EQ(ValueOf(*cell, "frames_solved"), 1);
  EXPECT_EQ(ValueOf(*cell, "frames_solved_tight"), 1);
  EXPECT_LT(*ValueOf(*cell, "position_error_cm"), 1e-9);
  EXPECT_LT(*ValueOf(*cell, "orientation_error_deg"), 1e-9);
  EXPECT_LT(*ValueOf(*cell, "hidden_angle_error_deg"), 1e-9);
  EXPECT_LT(*ValueOf(*cell, "mpjpe_mm"), 1e-9);
  EXPECT_NEAR(*ValueOf(*cell, "angle_jerk_ratio"), 1, 1e-9);
  EXPECT_EQ(ValueOf(*cell, "iterations_per_frame"), std::nullopt) << "it did not say";
  EXPECT_EQ(cell->recording->tracks.size(), 2u);
}

TEST(TrackingExchange, TheTruthMissesDisturbedTargets) {
  const auto task = MakeTrackingTask("{duration_s: 0.5, target_noise_cm: 1}");
  const auto world = task->MakeWorld(kTrackedWorld, false);
  const auto cell = world->Judge(*world->MakeTruth()->json);
  EXPECT_EQ(cell->status, Status::kUnsolved);
  EXPECT_NEAR(*ValueOf(*cell, "position_error_cm"), std::sqrt(8 / kPi), 0.3) << "mean of a three-dimensional normal";
  EXPECT_LT(*ValueOf(*cell, "mpjpe_mm"), 1e-9);
}

TEST(TrackingExchange, ScoresAnAnswerLikeABuiltInMethodThatFoundTheSame) {
  const auto world = MakeTrackingWorld({.duration_s = 0.5}, BuiltinClipOf("builtin:boxing"), kTrackedWorld);
  const auto answer = Follow(*world, {.name = "today", .solver = FindIkSolver("damped-least-squares"), .options = {}});
  Json told = {{"angles_deg", Json::array()}, {"iterations", *answer->iterations}};
  for (const auto& angles : answer->angles) {
    Json& frame = told["angles_deg"].emplace_back(Json::array());
    for (const double angle : angles) frame.push_back(Degrees(angle));
  }
  ASSERT_OK(read, ReadTrackingAnswer(told, *world));
  const CellResult built_in = ScoreTracking(*world, kRate, *answer, false);
  const CellResult judged = ScoreTracking(*world, kRate, *read, false);
  EXPECT_EQ(judged.status, built_in.status);
  ASSERT_EQ(judged.metrics.size(), built_in.metrics.size());
  for (std::size_t i = 0; i < judged.metrics.size(); ++i) {
    EXPECT_EQ(judged.metrics[i].id, built_in.metrics[i].id);
    EXPECT_NEAR(*judged.metrics[i].value, *built_in.metrics[i].value, 1e-9) << judged.metrics[i].id;
  }
}

TEST(TrackingExchange, AFrameThatBreaksALimitIsUnsolvedHoweverWellItMeetsItsTargets) {
  auto world = MakeTrackingWorld({.duration_s = 0.5}, BuiltinClipOf("builtin:boxing"), kTrackedWorld);
  const int elbow = world->tree.joints[kTreeLeftElbow].first_dof;
  world->truth[7].angles[elbow] = Radians(-5);
  world->targets[7] = TargetsMetBy(world->tree, world->truth[7]);
  TrackingAnswer answer;
  for (const TreeState& state : world->truth) answer.angles.push_back(state.angles);
  const CellResult cell = ScoreTracking(*world, kRate, answer, false);
  EXPECT_EQ(cell.status, Status::kUnsolved);
  EXPECT_THAT(cell.reason, HasSubstr(fmt::format(
                               "1 angle outside the limits; angles_deg[7][{}] is the farthest outside, by 5°", elbow)));
  EXPECT_NEAR(*ValueOf(cell, "frames_solved"), 14.0 / 15, 1e-12);
  EXPECT_LT(*ValueOf(cell, "position_error_cm"), 1e-9);
}

TEST(TrackingExchange, RefusesWhatIsNoAnswerNamingThePlaceInIt) {
  const auto task = MakeTrackingTask();
  const auto world = task->MakeWorld(kTrackedWorld, false);
  const Json good = *world->MakeTruth()->json;
  EXPECT_EQ(ComplaintAbout(*world, good), "no complaint");
  EXPECT_TRUE(testing::AnswersAreKept("tests/bench/tasks/tracking/complaints.txt", [&](const std::string& edit) {
    return ComplaintOfEdit(*world, good, edit);
  }));
}

TEST(TrackingExchange, ScoresOrRefusesWhateverIsSaid) {
  const auto task = MakeTrackingTask("{duration_s: 0.2}");
  const auto world = task->MakeWorld(kTrackedWorld, false);
  const Json good = *world->MakeTruth()->json;
  const Judgements judged = JudgeMutations(*world, {good}, 300, RandomStream(kTrackedWorld, "mutations"));
  EXPECT_GT(judged.refused, 50);
  EXPECT_LT(judged.refused, 300);
}

TEST(TrackingExchange, CreditsNoAnswerWithAFailure) {
  const auto task = MakeTrackingTask();
  EXPECT_EQ(task->ValueOfFailure("frames_solved"), 0);
  EXPECT_EQ(task->ValueOfFailure("frames_solved_tight"), 0);
  EXPECT_EQ(task->ValueOfFailure("mpjpe_mm"), std::nullopt);
}

}  // namespace
}  // namespace etude
