#include "bench/tasks/detection/exchange.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "bench/tasks/base/pose_json.h"
#include "bench/tasks/detection/score.h"
#include "engine/base/named.h"
#include "tests/bench/tasks/base/exchange_checks.h"
#include "tests/bench/tasks/detection/detection_fixture.h"
#include "tests/support/kept_answers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

class DetectionExchange : public DetectionFixture {
 protected:
  const std::unique_ptr<Task> task_ = *MakeTask(std::string("noise: 4\nevents: 6\n") + kFourMethods, FourMoves());

  /// Returns a built-in method's cell as the answer of an outside method with the same result.
  static Json AnswerOf(const CellResult& cell) {
    const Json found = Json::parse(cell.recording->extras_json);
    Json answer = {{"events", Json::array()}, {"alarms", found["alarms"]}};
    for (const Json& event : found["events"]) {
      const Json right_at = event.contains("called_frame") ? event["called_frame"] : Json(nullptr);
      answer["events"].push_back({{"right_at_frame", right_at}, {"score", event["score"]}});
    }
    return answer;
  }
};

SkeletonStream StreamOf(const Json& problem) {
  SkeletonStream stream{.rate_hz = problem["rate_hz"], .frames = {}};
  for (const Json& told : problem["frames"]) {
    SensedFrame& frame = stream.frames.emplace_back();
    const BodyPose pose = *ReadPose(told["pose"], "pose");
    const std::string states = told["states"];
    frame.body_seen = told["body_seen"];
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      const TrackingState state = states[i] == 't'   ? TrackingState::kTracked
                                  : states[i] == 'i' ? TrackingState::kInferred
                                                     : TrackingState::kNotTracked;
      frame.joints[i] = {pose.joints[i], state};
    }
  }
  return stream;
}

TEST_F(DetectionExchange, TellsEveryDigitOfWhatTheSensorSawAndNothingOfTheTruth) {
  const auto world = task_->MakeWorld(World(0), false);
  const Json problem = *ReadJson(*WriteJson(*world->MakeProblem()->json), "problem");
  EXPECT_EQ(WorldDigests({.stream = StreamOf(problem)})[1].second, DigestOf(world->Run(0), "stream"));
  ASSERT_EQ(problem["events"].size(), 6u);
  for (const Json& event : problem["events"]) {
    EXPECT_EQ(event.size(), 3u) << "move, begin_frame, end_frame: " << event;
    EXPECT_LT(event["begin_frame"], event["end_frame"]);
  }
}

TEST_F(DetectionExchange, TeachesWhatBuiltInRecognisersAreTaught) {
  const Payload setting = *task_->Setting();
  const Repertoire repertoire = RepertoireOf(FourMoves());
  ASSERT_EQ((*setting.json)["moves"].size(), repertoire.moves.size());
  ASSERT_EQ(setting.files.size(), repertoire.moves.size());
  for (std::size_t i = 0; i < repertoire.moves.size(); ++i) {
    const Json& told = (*setting.json)["moves"][i];
    const Move& move = repertoire.moves[i];
    const std::vector<TaughtPose>& taught = FindByName(repertoire.taught, move.name)->poses;
    EXPECT_EQ(told["name"], move.name);
    EXPECT_EQ(told["poses"].size(), move.motion.poses.size());
    EXPECT_EQ(told["file"], setting.files[i].name);
    ASSERT_EQ(told["key_poses"].size(), taught.size());
    for (std::size_t k = 0; k < taught.size(); ++k) {
      const Json& target = told["key_poses"][k]["targets"][0];
      EXPECT_EQ(*FindFeature(target["feature"].get<std::string>()), taught[k].targets[0].feature);
      EXPECT_EQ(target["degrees"], taught[k].targets[0].degrees);
      EXPECT_EQ(target["tolerance_deg"], taught[k].targets[0].tolerance_deg);
    }
  }
}

TEST_F(DetectionExchange, JudgesABuiltInMethodsVerdictAsTheMethodItself) {
  int alarms = 0, missed = 0;
  for (int trial = 0; trial < 16; ++trial) {
    const auto world = task_->MakeWorld(World(trial), true);
    for (std::size_t m = 0; m < 4; ++m) {
      SCOPED_TRACE(::testing::Message() << "trial " << trial << ", method " << m);
      const CellResult own = world->Run(m);
      const Json answer = AnswerOf(own);
      ASSERT_OK(judged, world->Judge(*ReadJson(*WriteJson(answer), "answer")));
      ASSERT_EQ(judged->metrics.size(), own.metrics.size());
      for (std::size_t i = 0; i < own.metrics.size(); ++i) {
        EXPECT_EQ(judged->metrics[i].id, own.metrics[i].id);
        // Skip two metrics: an answer names no moves, and AnswerOf copies false alarms but no correctly spotted moves.
        if (own.metrics[i].id == "move_named" || own.metrics[i].id == "right_spotted") continue;
        EXPECT_EQ(judged->metrics[i].value, own.metrics[i].value) << own.metrics[i].id;
        EXPECT_EQ(judged->metrics[i].null_reason, own.metrics[i].null_reason) << own.metrics[i].id;
      }
      EXPECT_EQ(DigestOf(*judged, "events"), DigestOf(own, "events"));
      alarms += static_cast<int>(answer["alarms"].size());
      for (const Json& event : answer["events"]) missed += event["right_at_frame"].is_null();
    }
  }
  EXPECT_GT(alarms, 0);
  EXPECT_GT(missed, 0);
}

TEST_F(DetectionExchange, ScoresTheTruthPerfectAndLiesWorse) {
  const auto world = task_->MakeWorld(World(1), false);
  const Json truth = *world->MakeTruth()->json;
  Json honest = {{"events", Json::array()}, {"alarms", Json::array()}};
  for (const Json& event : truth["events"]) {
    const bool right = event["is_right"];
    ASSERT_EQ(event.contains("first_right_s"), right);
    const Json frame = right ? Json(static_cast<int>(std::ceil(event["first_right_s"].get<double>() * 30))) : Json();
    honest["events"].push_back({{"right_at_frame", frame}, {"score", right ? 1 : -1}});
  }
  const CellResult perfect = *world->Judge(honest);
  EXPECT_EQ(ValueOf(perfect, "f1"), 1.0);
  EXPECT_EQ(ValueOf(perfect, "roc_auc"), 1.0);
  EXPECT_NEAR(*ValueOf(perfect, "latency_s"), 0, 1.0 / 30);
  EXPECT_EQ(ValueOf(perfect, "false_alarms_per_min"), 0.0);

  Json liar = honest;
  for (std::size_t i = 0; i < liar["events"].size(); ++i) {
    Json& event = liar["events"][i];
    event["score"] = -event["score"].get<double>();
    event["right_at_frame"] = truth["events"][i]["is_right"].get<bool>() ? Json() : truth["events"][i]["begin_frame"];
  }
  EXPECT_EQ(ValueOf(*world->Judge(liar), "f1"), 0.0);
  EXPECT_EQ(ValueOf(*world->Judge(liar), "roc_auc"), 0.0);
}

TEST_F(DetectionExchange, CountsAlarmsOutsideTheirMovesWindowsOnceEach) {
  const auto world = task_->MakeWorld(World(0), false);
  const Json asked = (*world->MakeProblem()->json)["events"];
  Json answer = {{"events", Json::array()}, {"alarms", Json::array()}};
  for (std::size_t i = 0; i < asked.size(); ++i) {
    answer["events"].push_back({{"right_at_frame", nullptr}, {"score", 0}});
  }
  const double none = *ValueOf(*world->Judge(answer), "false_alarms_per_min");
  EXPECT_EQ(none, 0);
  answer["alarms"] = {{{"move", asked[0]["move"]}, {"frame", asked[0]["begin_frame"]}}};
  EXPECT_EQ(ValueOf(*world->Judge(answer), "false_alarms_per_min"), 0.0) << "it was asked for then";
  answer["alarms"] = {{{"move", "sway"}, {"frame", 0}}};
  const double one = *ValueOf(*world->Judge(answer), "false_alarms_per_min");
  EXPECT_GT(one, 0);
  answer["alarms"].push_back(answer["alarms"][0]);
  EXPECT_EQ(ValueOf(*world->Judge(answer), "false_alarms_per_min"), one) << "said twice is said once";
  answer["alarms"][1]["frame"] = 5;
  EXPECT_DOUBLE_EQ(*ValueOf(*world->Judge(answer), "false_alarms_per_min"), 2 * one);
}

TEST_F(DetectionExchange, RefusesAWrongAnswerAndNamesThePlace) {
  const auto world = task_->MakeWorld(World(0), true);
  Json good = AnswerOf(world->Run(0));
  good["alarms"] = {{{"move", "clap"}, {"frame", 3}}};
  ASSERT_EQ(ComplaintAbout(*world, good), "no complaint");  // the control
  EXPECT_TRUE(testing::AnswersAreKept("tests/bench/tasks/detection/complaints.txt", [&](const std::string& edit) {
    return ComplaintOfEdit(*world, good, edit);
  }));
  const Json asked = (*world->MakeProblem()->json)["events"][2];
  const auto complaint = [&](const char* pointer, const Json& value) {
    return ComplaintWith(*world, good, pointer, value);
  };
  EXPECT_EQ(complaint("/events/2/score", std::numeric_limits<double>::infinity()),
            "events[2].score: inf is not a finite number");
  EXPECT_EQ(complaint("/events/2/right_at_frame", asked["end_frame"]),
            "events[2].right_at_frame: " + asked["end_frame"].dump() + "; allowed: " + asked["begin_frame"].dump() +
                "…" + std::to_string(asked["end_frame"].get<int>() - 1));
}

TEST_F(DetectionExchange, RefusesOrScoresWhateverIsSaid) {
  const auto world = task_->MakeWorld(World(0), true);
  const Json good = AnswerOf(world->Run(0));
  const auto [refused, scored] = JudgeMutations(*world, {good}, 200, RandomStream(World(0), "mutations"));
  EXPECT_GT(refused, 50);
  EXPECT_GT(scored, 10);
}

}  // namespace
}  // namespace etude
