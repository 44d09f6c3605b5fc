#include "bench/tasks/ik/exchange.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/ik/run.h"
#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/ik_solver.h"
#include "io/clips/clip_library.h"
#include "tests/bench/tasks/base/cell_values.h"
#include "tests/bench/tasks/base/exchange_checks.h"
#include "tests/bench/tasks/base/make_task.h"
#include "tests/support/kept_answers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const WorldKey kExchangeWorld{.suite_seed = 1, .scenario = "exchange", .trial = 0};
constexpr int kMaxSteps = 200;

std::unique_ptr<Task> MakeIkTask(const std::string& condition = "{}") {
  return *MakeTask(MakeIkTaskKind(), condition);
}

// A solver written from exchange.h alone, with plain lists of rows.
struct StrangersFrame {
  std::array<double, 3> p{};
  std::array<std::array<double, 3>, 3> R{};
};

std::array<std::array<double, 3>, 3> Times(const std::array<std::array<double, 3>, 3>& a,
                                           const std::array<std::array<double, 3>, 3>& b) {
  std::array<std::array<double, 3>, 3> product{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) product[i][j] += a[i][k] * b[k][j];
    }
  }
  return product;
}

StrangersFrame Beyond(const StrangersFrame& frame, const Json& offset) {
  StrangersFrame moved = frame;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) moved.p[i] += frame.R[i][k] * offset[k].get<double>();
  }
  return moved;
}

std::array<std::array<double, 3>, 3> Turn(const std::string& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  if (axis == "x") return {{{1, 0, 0}, {0, c, -s}, {0, s, c}}};
  if (axis == "y") return {{{c, 0, s}, {0, 1, 0}, {-s, 0, c}}};
  return {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
}

std::vector<StrangersFrame> StrangersEffectors(const Json& setting, const Json& root, const Json& angles_deg) {
  std::vector<StrangersFrame> joints, effectors;
  for (const Json& joint : setting["joints"]) {
    if (joint["parent"].is_null()) {
      joints.push_back({root["position_m"], root["rotation"]});
      continue;
    }
    StrangersFrame frame = Beyond(joints[joint["parent"].get<std::size_t>()], joint["offset_m"]);
    frame.R = Times(frame.R, joint["rest"]);
    int angle = joint["first_angle"];
    for (const Json& axis : joint["axes"]) {
      frame.R = Times(frame.R, Turn(axis, angles_deg[angle++].get<double>() * kPi / 180));
    }
    joints.push_back(frame);
  }
  for (const Json& effector : setting["effectors"]) {
    effectors.push_back(Beyond(joints[effector["joint"].get<std::size_t>()], effector["offset_m"]));
  }
  return effectors;
}

TEST(IkExchange, AStrangersForwardKinematicsReachesTheTargetsWithTheTrueAngles) {
  const auto task = MakeIkTask();
  const auto world = task->MakeWorld(kExchangeWorld, false);
  const Json setting = *task->Setting()->json, problem = *world->MakeProblem()->json, truth = *world->MakeTruth()->json;
  EXPECT_EQ(setting["angles"].size(), 29u);
  const auto reached = StrangersEffectors(setting, problem["root"], truth["angles_deg"]);
  const auto begun = StrangersEffectors(setting, problem["root"], problem["start_angles_deg"]);
  ASSERT_EQ(problem["targets"].size(), 4u);
  for (std::size_t e = 0; e < 4; ++e) {
    const Json& target = problem["targets"][e];
    EXPECT_EQ(target["effector"], setting["effectors"][e]["name"]);
    double distance = 0, begin_distance = 0;
    for (int i = 0; i < 3; ++i) {
      distance = std::max(distance, std::abs(reached[e].p[i] - target["position_m"][i].get<double>()));
      begin_distance = std::max(begin_distance, std::abs(begun[e].p[i] - target["position_m"][i].get<double>()));
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(reached[e].R[i][j], target["rotation"][i][j].get<double>(), 1e-12);
    }
    EXPECT_LT(distance, 1e-12);
    EXPECT_GT(begin_distance, 1e-3) << "a control: the start is elsewhere";
  }
}

TEST(IkExchange, TheProblemStartsWithinTheLimitsThatTheSettingNames) {
  const auto task = MakeIkTask("{joint_noise_deg: 60}");
  const Json setting = *task->Setting()->json, problem = *task->MakeWorld(kExchangeWorld, false)->MakeProblem()->json;
  for (std::size_t i = 0; i < 29; ++i) {
    const double start = problem["start_angles_deg"][i];
    EXPECT_GE(start, setting["angles"][i]["lower_deg"].get<double>() - 1e-9);
    EXPECT_LE(start, setting["angles"][i]["upper_deg"].get<double>() + 1e-9);
  }
  EXPECT_EQ(setting["angles"][0]["name"], "left_ankle.x");
  EXPECT_EQ(setting["max_steps"], 200);
  EXPECT_NEAR(setting["position_goal_cm"].get<double>(), 0.1, 1e-15);
}

TEST(IkExchange, TheSettingTellsTheLimitsAndWhatIsAsked) {
  const Json adult = *MakeIkTask()->Setting()->json;
  EXPECT_EQ(adult["asked"], Json({"position", "orientation"}));
  EXPECT_NEAR(adult["angles"][1]["upper_deg"].get<double>(), 135, 1e-9);
  const Json ama = *MakeIkTask("{limit_set: ama, targets: position}")->Setting()->json;
  EXPECT_EQ(ama["asked"], Json({"position"}));
  EXPECT_EQ(ama["angles"][1]["name"], "left_knee.x");
  EXPECT_NEAR(ama["angles"][1]["upper_deg"].get<double>(), 150, 1e-9) << "table 3.1, its last column";
}

TEST(IkExchange, TheTruthIsAPerfectAnswer) {
  const auto task = MakeIkTask();
  const auto world = task->MakeWorld(kExchangeWorld, true);
  Json answer = *world->MakeTruth()->json;
  answer["iterations"] = 7;
  ASSERT_OK(cell, world->Judge(answer));
  EXPECT_EQ(cell->status, Status::kOk) << cell->reason;
  EXPECT_LT(*ValueOf(*cell, "position_error_max_cm"), 1e-9);
  EXPECT_LT(*ValueOf(*cell, "orientation_error_max_deg"), 1e-5);  // acos is inaccurate near 1
  EXPECT_LT(*ValueOf(*cell, "hidden_angle_error_deg"), 1e-9);
  EXPECT_EQ(ValueOf(*cell, "solved_tight"), 1);
  EXPECT_EQ(ValueOf(*cell, "iterations_par2"), 7);
  EXPECT_EQ(ValueOf(*cell, "fk_evaluations"), std::nullopt) << "it did not say";
  EXPECT_EQ(ValueOf(*cell, "fk_evaluations_par2"), std::nullopt);
  ASSERT_TRUE(cell->recording);
  EXPECT_EQ(cell->recording->tracks.size(), 3u);
  EXPECT_EQ(cell->recording->tracks[2].motion.poses.size(), 2u);
}

TEST(IkExchange, ScoresAnAnswerLikeABuiltInMethodThatFoundTheSame) {
  const KinematicTree tree = MakeBodyTree({});
  const IkWorld world = MakeIkWorld(tree, {}, kExchangeWorld);
  IkMethod method{.name = "today", .solver = FindIkSolver("damped-least-squares")};
  const IkSolution solution = method.solver->solve(tree, world.problem, method.options);
  const CellResult built_in = RunIkCell(tree, world, method, {});
  const CellResult judged =
      ScoreIkAnswer(tree, world, {solution.angles, solution.iterations, solution.fk_evaluations}, kMaxSteps, {});
  EXPECT_EQ(judged.status, built_in.status);
  ASSERT_EQ(judged.metrics.size(), built_in.metrics.size());
  for (std::size_t i = 0; i < judged.metrics.size(); ++i) {
    EXPECT_EQ(judged.metrics[i].id, built_in.metrics[i].id);
    EXPECT_EQ(judged.metrics[i].value, built_in.metrics[i].value) << judged.metrics[i].id;
  }
}

TEST(IkExchange, AnAnswerThatBreaksALimitIsMeasuredAndUnsolved) {
  const KinematicTree tree = MakeBodyTree({});
  IkWorld world = MakeIkWorld(tree, {}, kExchangeWorld);
  // Targets that are reached exactly with an elbow bent the wrong way.
  const int elbow = tree.joints[kTreeLeftElbow].first_dof;
  world.truth.angles[elbow] = Radians(-5);
  world.problem.targets.clear();
  for (const LimbFrame& effector : ComputeFrames(tree, world.truth).effectors) {
    world.problem.targets.push_back({.position = effector.position, .axes = effector.axes});
  }
  const CellResult cell = ScoreIkAnswer(tree, world, {world.truth.angles, 3, 4}, kMaxSteps, {});
  EXPECT_EQ(cell.status, Status::kUnsolved);
  EXPECT_THAT(cell.reason, HasSubstr(fmt::format(
                               "1 angle outside the limits; angles_deg[{}] is the farthest outside, by 5°", elbow)));
  EXPECT_LT(*ValueOf(cell, "position_error_cm"), 1e-9);
  EXPECT_EQ(ValueOf(cell, "solved_practical"), 0);
  EXPECT_EQ(ValueOf(cell, "iterations_par2"), 2 * kMaxSteps);
  EXPECT_EQ(ValueOf(cell, "fk_evaluations_par2"), 2 * (kMaxSteps + 1));
}

TEST(IkExchange, CountsAnAnswerThatCostMoreThanTheLimitAsUnsolvedInItsPenalisedCost) {
  const KinematicTree tree = MakeBodyTree({});
  const IkWorld world = MakeIkWorld(tree, {}, kExchangeWorld);
  const CellResult cell = ScoreIkAnswer(tree, world, {world.truth.angles, kMaxSteps + 1, 4}, kMaxSteps, {});
  EXPECT_EQ(ValueOf(cell, "iterations_par2"), 2 * kMaxSteps);
  EXPECT_EQ(ValueOf(cell, "fk_evaluations_par2"), 4);
}

TEST(IkExchange, RefusesWhatIsNoAnswerNamingThePlaceInIt) {
  const auto task = MakeIkTask();
  const auto world = task->MakeWorld(kExchangeWorld, false);
  const Json good = *world->MakeTruth()->json;
  EXPECT_EQ(ComplaintAbout(*world, good), "no complaint");
  EXPECT_TRUE(testing::AnswersAreKept("tests/bench/tasks/ik/complaints.txt", [&](const std::string& edit) {
    return ComplaintOfEdit(*world, good, edit);
  }));
  EXPECT_THAT(ComplaintWith(*world, good, "/angles_deg/3", std::nan("")), HasSubstr("angles_deg[3]"));
}

TEST(IkExchange, CreditsNoAnswerWithAFailure) {
  const auto task = MakeIkTask("{max_sweeps: 50}");
  EXPECT_EQ(task->ValueOfFailure("solved_practical"), 0);
  EXPECT_EQ(task->ValueOfFailure("solved_tight"), 0);
  EXPECT_EQ(task->ValueOfFailure("iterations_par2"), 100);
  EXPECT_EQ(task->ValueOfFailure("fk_evaluations_par2"), 102);
  EXPECT_EQ(task->ValueOfFailure("position_error_cm"), std::nullopt);
  EXPECT_EQ(task->ValueOfFailure("iterations"), std::nullopt);
}

}  // namespace
}  // namespace etude
