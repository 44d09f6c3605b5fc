#include "bench/tasks/transition/exchange.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "bench/tasks/base/pose_json.h"
#include "tests/bench/tasks/base/mutate_json.h"
#include "tests/bench/tasks/transition/transition_fixture.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

struct NamedMethod {
  std::string join;
  bool matched;
  bool adaptive;
};

/// The methods below, as their answers say them.
const std::vector<NamedMethod> kSaid = {{"cut", false, false},         {"cut", true, false},  {"cut", true, true},
                                        {"inertialised-spring", true, false}, {"cut", false, false}, {"cut", true, false}};
constexpr const char* kAllKinds = R"(
wait_s: 0.5
methods:
  - {name: now, choice: now}
  - {name: fuzzy}
  - {name: adaptive, weights: adaptive}
  - {name: smooth, join: inertialised-spring}
  - {name: end, choice: wait-for-end}
  - {name: never, threshold: 0}
)";

class TransitionExchange : public TransitionFixture {
 protected:
  const ClipLibrary library_ = EveryMove();
  const std::unique_ptr<Task> task_ = *Make(kAllKinds, library_);

  int ClipNamed(const std::string& name) const {
    for (std::size_t i = 0; i < library_.clips.size(); ++i) {
      if (library_.clips[i].name == name) return static_cast<int>(i);
    }
    return -1;
  }

  static Json Facts(const CellResult& cell) { return Json::parse(cell.recording->extras_json); }

  /// What a method outside would say that found what this built-in one found.
  Json AnswerOf(const CellResult& cell, const NamedMethod& method) const {
    if (cell.status == Status::kUnsolved) return {{"unsolved", cell.reason}};
    const Json switches = Facts(cell)["switches"];
    Json answer = {{"leave_frame", switches.front()["from_frame"]}, {"enter_frame", switches.back()["to_frame"]}};
    for (std::size_t i = 1; i < switches.size(); ++i) {
      answer["through"].push_back({{"clip", ClipNamed(switches[i]["from"])},
                                   {"enter_frame", switches[i - 1]["to_frame"]},
                                   {"leave_frame", switches[i]["from_frame"]}});
    }
    if (method.join != "cut") answer["join"] = method.join;
    if (method.matched) answer["matched"] = true;
    return answer;
  }

  /// Judged after a way through text, as from a program.
  static Result<CellResult> JudgeText(TaskWorld& world, const Json& answer) {
    return world.Judge(*ReadJson(*WriteJson(answer), "answer"));
  }

  static std::string ComplaintAbout(TaskWorld& world, const Json& answer) {
    const auto judged = world.Judge(answer);
    return judged ? "no complaint" : judged.error().message;
  }
};

TEST_F(TransitionExchange, TellsEveryDigitThatBuiltInMethodsSee) {
  const Json setting = *ReadJson(*WriteJson(*task_->Setting()->json), "setting");
  const Stage stage = SetStage(library_);
  ASSERT_EQ(setting["clips"].size(), library_.clips.size());
  EXPECT_EQ(setting["rate_hz"], 30);
  EXPECT_EQ(setting["joints"][3], "head");
  EXPECT_EQ(setting["parents"][3], "shoulder_centre");
  for (std::size_t clip = 0; clip < library_.clips.size(); ++clip) {
    EXPECT_EQ(setting["clips"][clip]["name"], library_.clips[clip].name);
    EXPECT_EQ(setting["clips"][clip]["poses"], EncodePoses(stage.library.motions[clip].poses));
  }
  const Json problem = *task_->MakeWorld(Trial(2), false)->MakeProblem()->json;
  EXPECT_EQ(problem["from"], 2);
  EXPECT_NE(problem["to"], 2);
  EXPECT_EQ(problem["max_wait_s"], 0.5);
  EXPECT_LT(problem["request_frame"], setting["clips"][2]["poses"].size());
}

TEST_F(TransitionExchange, JudgesABuiltInMethodsPlanAsTheMethodItself) {
  int unsolved = 0, direct = 0, through = 0;
  for (int trial = 0; trial < 16; ++trial) {
    const auto world = task_->MakeWorld(Trial(trial), true);
    for (std::size_t m = 0; m < kSaid.size(); ++m) {
      SCOPED_TRACE(testing::Message() << "trial " << trial << ", method " << m);
      const CellResult own = world->Run(m);
      const auto judged = JudgeText(*world, AnswerOf(own, kSaid[m]));
      ASSERT_TRUE(judged) << judged.error().message;
      EXPECT_EQ(judged->status, own.status);
      EXPECT_EQ(judged->reason, own.reason);
      ASSERT_EQ(judged->metrics.size(), own.metrics.size());
      for (std::size_t i = 0; i < own.metrics.size(); ++i) {
        EXPECT_EQ(judged->metrics[i].id, own.metrics[i].id);
        // The distance of an answer is by paper A's weights, whatever it was found with.
        if (own.metrics[i].id == "fuzzy_distance" && kSaid[m].adaptive) continue;
        EXPECT_EQ(judged->metrics[i].value, own.metrics[i].value) << own.metrics[i].id;
        EXPECT_EQ(judged->metrics[i].null_reason, own.metrics[i].null_reason) << own.metrics[i].id;
      }
      EXPECT_EQ(judged->digests.back(), own.digests.back()) << "the motion shown";
      if (own.status == Status::kUnsolved) {
        ++unsolved;
      } else {
        Facts(own)["switches"].size() > 1 ? ++through : ++direct;
      }
    }
  }
  EXPECT_GT(unsolved, 0);
  EXPECT_GT(direct, 0);
  EXPECT_GT(through, 0);
}

TEST_F(TransitionExchange, ScoresFramesBetweenLikeTheInBetweenTheyWereTakenFrom) {
  int compared = 0;
  for (int trial = 0; trial < 16; ++trial) {
    const auto world = task_->MakeWorld(Trial(trial), true);
    const CellResult own = world->Run(1);
    if (own.status != Status::kOk || Facts(own)["switches"].size() != 2) continue;
    const Json facts = Facts(own);
    const std::vector<BodyPose>& shown = own.recording->tracks[0].motion.poses;
    const int first = facts["seam_frames"][0], last = facts["seam_frames"][1];
    Json answer = {{"leave_frame", facts["switches"][0]["from_frame"]},
                   {"enter_frame", facts["switches"][1]["to_frame"]}};
    answer["between"] = EncodePoses(std::span(shown).subspan(first + 1, last - first));
    const auto judged = JudgeText(*world, answer);
    ASSERT_TRUE(judged) << judged.error().message;
    for (const char* id : {"jump_cm", "mean_joint_jump_cm", "jerk_peak_mps3", "natural_share", "foot_slide_cmps",
                           "sparc", "wait_s", "rotation_step_change_deg"}) {
      EXPECT_NEAR(ValueOf(*judged, id), ValueOf(own, id), 1e-6 * (1 + std::abs(ValueOf(own, id)))) << id;
    }
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

TEST_F(TransitionExchange, ScoresAWorseAnswerWorse) {
  const auto world = task_->MakeWorld(Trial(0), true);
  const Json problem = *world->MakeProblem()->json;
  const int request = problem["request_frame"];
  const Json clip = (*task_->Setting()->json)["clips"][problem["from"].get<int>()]["poses"];
  const Json soon = {{"leave_frame", request}, {"enter_frame", 0}};
  const Json late = {{"leave_frame", clip.size() - 1}, {"enter_frame", 0}};
  EXPECT_LT(ValueOf(*world->Judge(soon), "wait_s"), ValueOf(*world->Judge(late), "wait_s"));

  Json stay = soon, leap = soon;  // the frame left is held for a frame; or the whole body leaps five metres to the side
  BodyPose pose = *ReadPose(clip[request], "");
  stay["between"] = {EncodePose(pose)};
  for (glm::dvec3& joint : pose.joints) joint.x += 5;
  leap["between"] = {EncodePose(pose)};
  const auto calm = world->Judge(stay), wild = world->Judge(leap);
  EXPECT_GT(ValueOf(*wild, "jump_cm"), ValueOf(*calm, "jump_cm") + 50);
  EXPECT_GT(ValueOf(*wild, "pose_gap_cm"), ValueOf(*calm, "pose_gap_cm") + 50);
  EXPECT_GT(ValueOf(*wild, "velocity_gap_cmps"), ValueOf(*calm, "velocity_gap_cmps"));
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
  const auto complaint = [&](const char* pointer, const Json& value) {
    Json bad = good;
    bad[Json::json_pointer(pointer)] = value;
    return ComplaintAbout(*world, bad);
  };
  EXPECT_EQ(complaint("/leave_frame", 100000),
            "leave_frame: 100000; allowed: " + std::to_string(request) + "…" + std::to_string(clip.size() - 1));
  EXPECT_THAT(complaint("/leave_frame", request - 1), HasSubstr("leave_frame: "));
  EXPECT_EQ(complaint("/leave_frame", "soon"), "leave_frame: \"soon\" is not a whole number");
  EXPECT_EQ(complaint("/enter_frame", 3.5), "enter_frame: 3.5 is not a whole number");
  EXPECT_THAT(complaint("/enter_frame", -1), HasSubstr("enter_frame: -1; allowed: 0…"));
  EXPECT_EQ(complaint("/join", "glue"), "join: \"glue\"; allowed: cut, inertialised-spring");
  EXPECT_EQ(complaint("/join", "inertialised-spring"), "join: only 'cut' together with 'between'");
  EXPECT_EQ(complaint("/matched", 1), "matched: 1; allowed: true, false");
  EXPECT_THAT(complaint("/entr_frame", 1), HasSubstr("unknown key 'entr_frame'; did you mean 'enter_frame'?"));
  EXPECT_EQ(complaint("/between", 7), "between: 7 is not a list");
  EXPECT_EQ(complaint("/between/1", Json::array({1, 2})), "between[1]: 2 numbers, not 60");
  EXPECT_EQ(complaint("/between/1/7", nullptr), "between[1][7]: null is not a finite number");
  EXPECT_EQ(complaint("/between/0/59", std::numeric_limits<double>::quiet_NaN()),
            "between[0][59]: nan is not a finite number");
  EXPECT_EQ(complaint("/between/0/0", 1e30), "between[0][0]: 1e+30; allowed: -1000…1000");
  EXPECT_THAT(complaint("/between/1/9", clip[request][9].get<double>() + 0.3), HasSubstr("between[1]: head is 0."));
  EXPECT_EQ(complaint("/between", Json(std::vector<Json>(301, clip[0]))), "between: 301 entries; allowed: 0…300");
  EXPECT_EQ(complaint("/through", {{{"clip", 99}, {"enter_frame", 0}, {"leave_frame", 9}}}),
            "through[0].clip: 99; allowed: 0…" + std::to_string(library_.clips.size() - 1));
  EXPECT_EQ(complaint("/through", {{{"clip", 1}, {"enter_frame", 5}, {"leave_frame", 5}}}).substr(0, 36),
            "through[0].leave_frame: 5; allowed: ");
  EXPECT_EQ(complaint("/through", {{{"clip", 1}, {"enter_frame", 0}, {"leave_frame", 9}}}),
            "through: not together with 'between'");
  EXPECT_EQ(ComplaintAbout(*world, Json::array({1, 2})), "the answer: a list of 2 is not an object");
  EXPECT_EQ(ComplaintAbout(*world, {{"enter_frame", 1}}), "leave_frame: it is missing");
  EXPECT_EQ(ComplaintAbout(*world, {{"unsolved", ""}}), "unsolved: \"\" is not a text");
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
  RandomStream dice(Trial(0), "mutations");
  int refused = 0, scored = 0;
  for (int i = 0; i < 600; ++i) {
    const Json answer = Mutated(good[i % good.size()], dice);
    const auto judged = world->Judge(answer);
    judged ? ++scored : ++refused;
    if (!judged) {
      EXPECT_FALSE(judged.error().message.empty());
      continue;
    }
    for (const MetricValue& metric : judged->metrics) {
      EXPECT_TRUE(std::isfinite(metric.value.value_or(0))) << metric.id << " of " << answer;
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(scored, 10);
}

TEST_F(TransitionExchange, HasNothingToAskWhereAWorldIsSkipped) {
  const ClipLibrary single{{Builtin("clap")}};
  const auto task = *Make(kAllKinds, single);
  const auto world = task->MakeWorld(Trial(0), false);
  EXPECT_FALSE(world->MakeProblem());
  EXPECT_FALSE(world->MakeTruth());
  EXPECT_FALSE(world->Judge({{"unsolved", "no clip"}}));
}

TEST_F(TransitionExchange, TellsTheJumpThatStillCountsAsNatural) {
  for (int trial = 0; trial < 8; ++trial) {
    const auto world = task_->MakeWorld(Trial(trial), false);
    const double limit = (*world->MakeTruth()->json)["natural_limit_cm"];
    const CellResult cell = world->Run(3);
    if (cell.status != Status::kOk) continue;
    EXPECT_EQ(ValueOf(cell, "natural_share"), ValueOf(cell, "jump_cm") < limit ? 1 : 0);
  }
}

}  // namespace
}  // namespace etude
