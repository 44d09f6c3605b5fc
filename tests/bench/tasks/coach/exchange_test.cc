#include "bench/tasks/coach/exchange.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "bench/tasks/base/pose_json.h"
#include "engine/recognition/sight.h"
#include "engine/recognition/skeleton_stream.h"
#include "tests/bench/tasks/coach/coach_fixture.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

/// A program inside this process.
class Imagined final : public LiveProgram {
 public:
  explicit Imagined(std::function<Json(const Json&)> answer) : answer_(std::move(answer)) {}
  bool Begin(const Payload& session) override {
    seat = (*session.json)["seat"].get<std::string>();
    return true;
  }
  JsonPtr Step(const Payload& step) override {
    ++steps;
    const Json answer = answer_(*step.json);
    return answer.is_null() ? nullptr : JsonPtr(new Json(answer));
  }

  std::string seat;
  int steps = 0;

 private:
  std::function<Json(const Json&)> answer_;
};

CoachMethod Seated(Seat seat) {
  CoachMethod method = MethodOf("at-first-mistake");
  method.seat = seat;
  return method;
}

Result<SessionLog> RunSeated(Seat seat, LiveProgram& program) {
  const CoachStage& stage = StageOf("groove");
  CoachCondition condition = ConditionOf("groove", 20, 1);
  condition.sight.session.people = People::kAdult;
  const auto ready = CoachesOf(stage, {Seated(seat)});
  return RunMethod(ready[0], condition, stage, WorldOf(condition), &program);
}

TEST(Seats, AreToldWhichTheyAreAndAskedOnceAFrame) {
  Imagined recogniser([](const Json&) { return Json{{"asked", 0}}; });
  ASSERT_TRUE(RunSeated(Seat::kRecogniser, recogniser));
  EXPECT_EQ(recogniser.seat, "recogniser");
  Imagined policy([](const Json&) { return Json{{"correct", false}}; });
  ASSERT_OK(log, RunSeated(Seat::kPolicy, policy));
  EXPECT_EQ(policy.seat, "policy");
  EXPECT_EQ(policy.steps, log->Frames());
  EXPECT_TRUE(log->corrections.empty());
}

TEST(Seats, APolicyThatAlwaysCorrectsIsObeyed) {
  Imagined policy([](const Json&) { return Json{{"correct", true}}; });
  ASSERT_OK(log, RunSeated(Seat::kPolicy, policy));
  EXPECT_FALSE(log->corrections.empty());
}

TEST(Seats, ALearnerIsSeenWhereItSaysItIs) {
  const CoachStage& stage = StageOf("groove");
  const BodyPose standing = stage.dance().motion.poses.front();
  Imagined learner([&](const Json& step) {
    if (step.contains("test")) return Json{{"right", step["test"]["move"] == "clap"}};
    return Json{{"pose", EncodePose(standing)}, {"right", false}};
  });
  ASSERT_OK(log, RunSeated(Seat::kLearner, learner));
  EXPECT_EQ(log->learner.poses[100].joints, standing.joints);
  EXPECT_EQ(log->test.size(), stage.moves.size());
  EXPECT_EQ(std::count(log->test.begin(), log->test.end(), 1.0), 1);
  EXPECT_GT(TallyOf(*log).due, 0);
}

TEST(Seats, AProgramThatFailsIsAskedNoMore) {
  Imagined recogniser([](const Json&) { return Json(); });
  ASSERT_OK(log, RunSeated(Seat::kRecogniser, recogniser));  // the caller knows how the program failed
}

struct WrongAnswer {
  Seat seat;
  std::string answer, complaint;
};

class WrongAnswers : public ::testing::TestWithParam<WrongAnswer> {};

TEST_P(WrongAnswers, AreRefusedWithTheirPlace) {
  const WrongAnswer& wrong = GetParam();
  Imagined program([&](const Json&) { return Json::parse(wrong.answer); });
  EXPECT_THAT(testing::Message(RunSeated(wrong.seat, program)), HasSubstr(wrong.complaint));
  EXPECT_EQ(program.steps, 1);
}

INSTANTIATE_TEST_SUITE_P(Seats, WrongAnswers,
                         ::testing::Values(WrongAnswer{Seat::kRecogniser, R"({"asked": 2})", "asked: "},
                                           WrongAnswer{Seat::kRecogniser, R"({})", "asked"},
                                           WrongAnswer{Seat::kRecogniser, R"({"asked": 0, "spotted": [1]})", "spotted"},
                                           WrongAnswer{Seat::kRecogniser, R"({"asked": 0, "score": 1})", "score"},
                                           WrongAnswer{Seat::kPolicy, R"({"correct": 1})", "correct"},
                                           WrongAnswer{Seat::kPolicy, R"({"corect": true})", "corect"},
                                           WrongAnswer{Seat::kLearner, R"({"right": true})", "pose"},
                                           WrongAnswer{Seat::kLearner, R"({"pose": [1, 2]})", "pose"}));

TEST(Seats, ABuiltInRecogniserPutInItsSeatDecidesTheSame) {
  const CoachStage& stage = StageOf("groove");
  CoachCondition condition = ConditionOf("groove", 40, 1);
  condition.sight.session.people = People::kAdult;
  const CoachWorld world = WorldOf(condition);
  const auto built_in = CoachesOf(stage, {MethodOf("at-first-mistake")});
  const auto plain = RunMethod(built_in[0], condition, stage, world, nullptr);

  const auto follower = built_in[0].recogniser->Follow(kJudgedRateHz);
  StandingHeight standing(kJudgedRateHz);
  Imagined program([&](const Json& step) {
    if (step.contains("ask")) {
      const Json& move = step["ask"]["move"];
      const auto named = [&](const Move& each) { return Json(each.name) == move; };
      const auto found = std::ranges::find_if(stage.moves, named);
      follower->Ask(found == stage.moves.end()
                        ? std::nullopt
                        : std::optional<std::size_t>(static_cast<std::size_t>(found - stage.moves.begin())));
    }
    SensedFrame frame;
    const BodyPose pose = *ReadPose(step["pose"], "pose");
    const std::string states = step["states"].get<std::string>();
    frame.body_seen = step["body_seen"].get<bool>();
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      frame.joints[j] = {pose.joints[j], states[j] == 't'   ? TrackingState::kTracked
                                         : states[j] == 'i' ? TrackingState::kInferred
                                                            : TrackingState::kNotTracked};
    }
    standing.Update(frame);
    const FeatureFrame features = SeeFeatures(frame, standing.Value());
    return Json{{"asked", follower->Update({frame, features}).asked}};
  });
  const auto seated = CoachesOf(stage, {Seated(Seat::kRecogniser)});
  const auto outside = RunMethod(seated[0], condition, stage, world, &program);
  ASSERT_TRUE(plain && outside);
  ASSERT_EQ(plain->performances.size(), outside->performances.size());
  EXPECT_EQ(plain->modes, outside->modes);
}

}  // namespace
}  // namespace etude
