#include "bench/tasks/transition/exchange.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "bench/metrics/transition_smoothness.h"
#include "bench/tasks/base/pose_json.h"
#include "bench/tasks/transition/outcome.h"
#include "engine/motion/body.h"
#include "engine/transitions/choices/choice.h"
#include "tests/bench/tasks/base/exchange_checks.h"
#include "tests/bench/tasks/transition/transition_fixture.h"
#include "tests/support/kept_answers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// Returns every choice with every join, in the order of the registries.
std::string EveryMethod() {
  std::string yaml = "wait_s: 0.5\nmethods:\n";
  for (const Choice& choice : AllChoices()) {
    for (const auto& join : AllJoins()) {
      yaml += fmt::format("  - {{name: {0}~{1}, choice: {0}, join: {1}}}\n", choice.name, join.name);
    }
  }
  return yaml;
}

class TransitionExchange : public TransitionFixture {
 protected:
  const ClipLibrary library_ = EveryMove();
  const std::unique_ptr<Task> task_ = *Make(EveryMethod(), library_);

  const Stage stage_ = SetStage(library_);

  static Json Facts(const CellResult& cell) { return Json::parse(cell.recording->extras_json); }

  /// Returns a built-in method's record as the answer of an outside method with the same result.
  Json AnswerOf(const TransitionRecord& record, const Choice& choice, const std::string& join) const {
    if (record.segments.empty()) return {{"unsolved", record.why}};
    Json answer = {{"leave_frame", record.segments.front().last},
                   {"enter_frame", record.segments.back().first},
                   {"join", join},
                   {"matched", choice.matches_poses && record.branch != Branch::kForced}};
    if (const auto& preferred = record.segments.back().preferred) {
      answer["join_s"] = preferred->blend_s;
      answer["fades"] = preferred->way == JoinStyle::kFades;
      answer["direct"] = preferred->way == JoinStyle::kDirect;
    }
    if (record.segments.size() == 2) return answer;
    EXPECT_EQ(record.segments.size(), 3u);
    const Segment &before = record.segments[0], &own = record.segments[1];
    const FloorMove place =
        own.in_place ? FloorMove{}
                     : AlignOnFloor(own.own[own.first], stage_.library.motions[before.clip].poses[before.last]);
    answer["between_start"] = EncodePose(place.Apply(own.own[own.first]));
    for (int frame = own.first + 1; frame <= own.last; ++frame) {
      answer["between"].push_back(EncodePose(place.Apply(own.own[frame])));
    }
    return answer;
  }

  /// Returns true if a metric is computed over all pairs that a built-in choice accepts by its threshold. An outside
  /// method has no threshold.
  static bool IsOfAThreshold(const std::string& id) {
    return id == "direct_match" || id == "matching_share" || id == "false_smooth_share";
  }

  double PoseGapAtFirstPoint(const Json& answer, const TransitionRequest& request) const {
    const PlacedPoint point =
        FollowAnswer(*ReadTransitionAnswer(answer, stage_, request), stage_, request).splice.points.front();
    return PoseGapCm(point.leaving, point.arriving);
  }

  static Result<CellResult> JudgeText(TaskWorld& world, const Json& answer) {
    return world.Judge(*ReadJson(*WriteJson(answer), "answer"));
  }
};

TEST_F(TransitionExchange, TellsEveryDigitThatBuiltInMethodsSee) {
  const Json setting = *ReadJson(*WriteJson(*task_->Setting()->json), "setting");
  ASSERT_EQ(setting["clips"].size(), library_.clips.size());
  EXPECT_EQ(setting["rate_hz"], 30);
  EXPECT_EQ(setting["joints"][3], "head");
  EXPECT_EQ(setting["parents"][3], "shoulder_centre");
  for (std::size_t clip = 0; clip < library_.clips.size(); ++clip) {
    EXPECT_EQ(setting["clips"][clip]["name"], library_.clips[clip].name);
    EXPECT_EQ(setting["clips"][clip]["poses"], EncodePoses(stage_.library.motions[clip].poses));
  }
  const Json problem = *task_->MakeWorld(Trial(2), false)->MakeProblem()->json;
  EXPECT_EQ(problem["from"], 2);
  EXPECT_NE(problem["to"], 2);
  EXPECT_EQ(problem["max_wait_s"], 0.5);
  EXPECT_LT(problem["request_frame"], setting["clips"][2]["poses"].size());
}

TEST_F(TransitionExchange, JudgesABuiltInMethodsPlanAsTheMethodItself) {
  int unsolved = 0, direct = 0, between = 0;
  for (int trial = 0; trial < 4; ++trial) {
    const auto world = task_->MakeWorld(Trial(trial), true);
    TransitionRequest request = *DrawRequest(stage_, Trial(trial));
    request.budget_s = 0.5;
    std::size_t method = 0;
    for (const Choice& choice : AllChoices()) {
      const TransitionRecord record = choice.plan(stage_.library, request, {}, {});
      record.segments.empty() ? ++unsolved : record.segments.size() > 2 ? ++between : ++direct;
      const bool answers = choice.name != "unbroken";  // `unbroken` is a yardstick that stays in the clip
      for (const auto& join : AllJoins()) {
        SCOPED_TRACE(::testing::Message() << "trial " << trial << ", " << choice.name << ", " << join.name);
        const CellResult own = world->Run(method++);
        if (!answers) continue;
        ASSERT_OK(judged, JudgeText(*world, AnswerOf(record, choice, join.name)));
        EXPECT_EQ(judged->status, own.status);
        EXPECT_EQ(judged->reason, own.reason);
        ASSERT_EQ(judged->metrics.size(), own.metrics.size());
        for (std::size_t i = 0; i < own.metrics.size(); ++i) {
          EXPECT_EQ(judged->metrics[i].id, own.metrics[i].id);
          if (IsOfAThreshold(own.metrics[i].id)) continue;
          ASSERT_EQ(judged->metrics[i].value.has_value(), own.metrics[i].value.has_value()) << own.metrics[i].id;
          // Features of a turned body differ in the last digits.
          const double tolerance = own.metrics[i].id == "fuzzy_distance" ? 1e-9 : 0;
          EXPECT_NEAR(judged->metrics[i].value.value_or(0), own.metrics[i].value.value_or(0), tolerance)
              << own.metrics[i].id;
          EXPECT_EQ(judged->metrics[i].null_reason, own.metrics[i].null_reason) << own.metrics[i].id;
        }
        EXPECT_EQ(judged->digests.back(), own.digests.back()) << "the motion shown";
      }
    }
  }
  EXPECT_GT(direct, 0);
  EXPECT_GT(between, 0);
  EXPECT_EQ(unsolved, 0) << "a library with an in-between always has a way";
}

TEST_F(TransitionExchange, PlaysAClipOnTheWayLikeItsFramesPutBetween) {
  const auto world = task_->MakeWorld(Trial(3), true);
  const TransitionRequest request = *DrawRequest(stage_, Trial(3));
  const int way = (request.to + 1) % static_cast<int>(library_.clips.size());
  const std::vector<BodyPose>& on_the_way = stage_.library.motions[way].poses;
  const int leave = request.request_frame + 1;
  const FloorMove place = AlignOnFloor(on_the_way[2], stage_.library.motions[request.from].poses[leave]);
  for (const auto& join : AllJoins()) {
    if (join.align != nullptr) continue;  // aligns clips by their feet; an outside method's frames are not aligned
    const Json through = {{"leave_frame", leave},
                          {"enter_frame", 3},
                          {"join", join.name},
                          {"through", {{{"clip", way}, {"enter_frame", 2}, {"leave_frame", 9}}}}};
    Json between = {{"leave_frame", leave}, {"enter_frame", 3}, {"join", join.name}};
    between["between_start"] = EncodePose(place.Apply(on_the_way[2]));
    for (int frame = 3; frame <= 9; ++frame) between["between"].push_back(EncodePose(place.Apply(on_the_way[frame])));
    const auto expected = JudgeText(*world, through), judged = JudgeText(*world, between);
    ASSERT_TRUE(expected && judged);
    for (const char* id : {"pose_gap_cm", "velocity_gap_cmps", "wait_s"}) {
      EXPECT_NEAR(ValueOf(*judged, id), ValueOf(*expected, id), 1e-9) << join.name << ", " << id;
    }
    if (join.name != "cut") continue;  // other joins start from the clip's frame before, which is not in the problem
    for (const char* id : {"jump_cm", "foot_slide_cmps", "sparc", "ldlj"}) {
      EXPECT_NEAR(ValueOf(*judged, id), ValueOf(*expected, id), 1e-9) << id;
    }
  }
}

TEST_F(TransitionExchange, TakesFramesBetweenToBeginAtASteadySpeedUnlessToldWhere) {
  const auto world = task_->MakeWorld(Trial(0), true);
  const TransitionRequest request = *DrawRequest(stage_, Trial(0));
  const BodyPose left = stage_.library.motions[request.from].poses[request.request_frame];
  const auto moved = [&](double metres) {
    BodyPose pose = left;
    for (glm::dvec3& joint : pose.joints) joint.x += metres;
    return EncodePose(pose);
  };
  Json answer = {{"leave_frame", request.request_frame}, {"enter_frame", 0}, {"between", {moved(0.5), moved(0.6)}}};
  EXPECT_EQ(Facts(*world->Judge(answer))["transition_frames"].size(), 2u);
  const double steady = PoseGapAtFirstPoint(answer, request);
  answer["between_start"] = moved(0);
  const double told = PoseGapAtFirstPoint(answer, request);
  EXPECT_NEAR(steady, 40, 1e-9);
  EXPECT_NEAR(told, 0, 1e-9);
}

TEST_F(TransitionExchange, ScoresAWorseAnswerWorse) {
  const auto world = task_->MakeWorld(Trial(0), true);
  const Json problem = *world->MakeProblem()->json;
  const int request = problem["request_frame"];
  const Json clip = (*task_->Setting()->json)["clips"][problem["from"].get<int>()]["poses"];
  const Json soon = {{"leave_frame", request}, {"enter_frame", 0}};
  const Json late = {{"leave_frame", clip.size() - 1}, {"enter_frame", 0}};
  EXPECT_LT(ValueOf(*world->Judge(soon), "wait_s"), ValueOf(*world->Judge(late), "wait_s"));

  // Both answers show one frame in between: the pose at which the clip is left, in `leap` moved five metres sideways.
  Json stay = soon, leap = soon;
  BodyPose pose = *ReadPose(clip[request], "");
  stay["between"] = Json::array({EncodePose(pose)});
  for (glm::dvec3& joint : pose.joints) joint.x += 5;
  leap["between"] = Json::array({EncodePose(pose)});
  ASSERT_OK(calm, world->Judge(stay));
  ASSERT_OK(wild, world->Judge(leap));
  EXPECT_GT(ValueOf(*wild, "jump_cm"), ValueOf(*calm, "jump_cm") + 50);
  EXPECT_GT(ValueOf(*wild, "pose_gap_cm"), ValueOf(*calm, "pose_gap_cm") + 50);
  Json rush = stay;  // five metres within a frame
  rush["between"].push_back(leap["between"][0]);
  EXPECT_GT(ValueOf(*world->Judge(rush), "velocity_gap_cmps"), ValueOf(*calm, "velocity_gap_cmps") + 5000);
  EXPECT_EQ(ValueOf(*wild, "natural_share"), 0);
  EXPECT_EQ(ValueOf(*wild, "wait_s"), 1.0 / 30);
}

TEST_F(TransitionExchange, RefusesAWrongAnswerAndNamesThePlace) {
  const auto world = task_->MakeWorld(Trial(0), false);
  const Json problem = *world->MakeProblem()->json;
  const int request = problem["request_frame"];
  const Json clip = (*task_->Setting()->json)["clips"][problem["from"].get<int>()]["poses"];
  const Json good = {{"leave_frame", request}, {"enter_frame", 3}, {"between", {clip[request], clip[request]}}};
  ASSERT_EQ(ComplaintAbout(*world, good), "no complaint");  // the control
  EXPECT_TRUE(testing::AnswersAreKept("tests/bench/tasks/transition/complaints.txt", [&](const std::string& edit) {
    return ComplaintOfEdit(*world, good, edit);
  }));
  const auto complaint = [&](const char* pointer, const Json& value) {
    return ComplaintWith(*world, good, pointer, value);
  };
  EXPECT_EQ(complaint("/leave_frame", 100000),
            "leave_frame: 100000; allowed: " + std::to_string(request) + "…" + std::to_string(clip.size() - 1));
  EXPECT_THAT(complaint("/leave_frame", request - 1), HasSubstr("leave_frame: "));
  EXPECT_EQ(ComplaintAbout(*world, {{"leave_frame", request}, {"enter_frame", 3}, {"between_start", clip[0]}}),
            "between_start: only together with 'between'");
  EXPECT_EQ(complaint("/between/0/59", std::nan("")), "between[0][59]: nan is not a finite number");
  EXPECT_THAT(complaint("/between/1/9", clip[request][9].get<double>() + 0.3), HasSubstr("between[1]: head is 0."));
  EXPECT_EQ(complaint("/between", Json(std::vector<Json>(301, clip[0]))), "between: found 301 entries; allowed: 0…300");
  EXPECT_EQ(complaint("/through", {{{"clip", 99}, {"enter_frame", 0}, {"leave_frame", 9}}}),
            "through[0].clip: 99; allowed: 0…" + std::to_string(library_.clips.size() - 1));
}

TEST_F(TransitionExchange, RefusesOrScoresWhateverIsSaid) {
  const auto world = task_->MakeWorld(Trial(1), true);
  const Json problem = *world->MakeProblem()->json;
  const Json pose = (*task_->Setting()->json)["clips"][1]["poses"][problem["request_frame"].get<int>()];
  const Json leave = problem["request_frame"];
  const std::vector<Json> good = {
      {{"leave_frame", leave}, {"enter_frame", 3}, {"between", {pose, pose}}},
      {{"leave_frame", leave}, {"enter_frame", 3}, {"join", "inertialised-spring"}, {"matched", true}},
      {{"leave_frame", leave},
       {"enter_frame", 3},
       {"through", {{{"clip", 3}, {"enter_frame", 0}, {"leave_frame", 9}}}}}};
  const auto [refused, scored] = JudgeMutations(*world, good, 600, RandomStream(Trial(0), "mutations"));
  EXPECT_GT(refused, 100);
  EXPECT_GT(scored, 10);
}

TEST_F(TransitionExchange, HasNothingToAskWhereAWorldIsSkipped) {
  const ClipLibrary single{{Builtin("clap")}};
  const auto task = *Make(EveryMethod(), single);
  const auto world = task->MakeWorld(Trial(0), false);
  EXPECT_FALSE(world->MakeProblem());
  EXPECT_FALSE(world->MakeTruth());
  EXPECT_FALSE(world->Judge({{"unsolved", "no clip"}}));
}

TEST_F(TransitionExchange, TellsTheJumpThatStillCountsAsNatural) {
  for (int trial = 0; trial < 8; ++trial) {
    const auto world = task_->MakeWorld(Trial(trial), false);
    const double limit = (*world->MakeTruth()->json)["natural_limit_cm"];
    const CellResult cell = world->Run(1);  // paper A's choice with the second join
    if (cell.status != Status::kOk) continue;
    EXPECT_EQ(ValueOf(cell, "natural_share"), ValueOf(cell, "jump_cm") <= limit * (1 + 1e-9) ? 1 : 0);
  }
}

}  // namespace
}  // namespace etude
