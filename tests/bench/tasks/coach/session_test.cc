#include "bench/tasks/coach/session.h"

#include <gtest/gtest.h>

#include "sim/choreography/song.h"
#include "tests/bench/tasks/coach/coach_fixture.h"

namespace etude {
namespace {

constexpr double kWholeSong = 170;  // seconds, after which the song starts again

TEST(CoachSession, NeverCorrectsWhoDancesAsTaughtBeforeAPerfectSensor) {
  int performances = 0;
  for (const std::string& song : BuiltinSongNames()) {
    const CoachStage& stage = StageOf(song);
    const CoachWorld world = WorldOf(ConditionOf(song, kWholeSong, 0));
    for (const ReadyCoach& ready : CoachesOf(stage, {MethodOf("at-first-mistake")})) {
      Mimic player(stage);
      const SessionLog log = SessionWith(ready, world, player);
      EXPECT_TRUE(log.corrections.empty()) << song;
      for (const LoggedPerformance& performance : log.performances)
        EXPECT_TRUE(performance.judged.called_right) << song;
      performances += static_cast<int>(log.performances.size());
    }
  }
  EXPECT_GT(performances, 80);
}

TEST(CoachSession, NeverPraisesWhoIsNotThere) {
  const CoachStage& stage = StageOf("groove");
  for (const double noise : {0.0, 1.0}) {
    const CoachWorld world = WorldOf(ConditionOf("groove", 60, noise));
    for (const ReadyCoach& ready : CoachesOf(stage, {MethodOf("at-first-mistake"), MethodOf("never")})) {
      Mimic player(stage, EveryRepetition(stage));
      const SessionLog log = SessionWith(ready, world, player);
      const CorrectionTally tally = TallyOf(log);
      EXPECT_GT(tally.due, 2);
      EXPECT_EQ(tally.wrong_praise, 0);
      EXPECT_EQ(tally.unneeded, 0);
      EXPECT_EQ(tally.missed, ready.method.name == "never" ? tally.due : 0);
    }
  }
}

TEST(CoachSession, TheOracleCorrectsWhatWasWrongAndNothingElse) {
  const CoachStage& stage = StageOf("groove");
  const CoachWorld world = WorldOf(ConditionOf("groove", 120, 2));  // the sensor is not used here
  CoachMethod method = MethodOf("oracle");
  method.coach.most_corrections = 100;  // so that the coach does not give up
  const auto ready = CoachesOf(stage, {method});
  Mimic player(stage, {2, 5});
  const SessionLog log = SessionWith(ready[0], world, player);
  const CorrectionTally tally = TallyOf(log);
  EXPECT_GT(tally.due, 0);
  EXPECT_EQ(tally.missed, 0);
  EXPECT_EQ(tally.unneeded, 0);
  EXPECT_EQ(tally.wrong_praise, 0);
}

TEST(CoachSession, CutOffPerformancesAreNotCounted) {
  const CoachStage& stage = StageOf("groove");
  const CoachWorld world = WorldOf(ConditionOf("groove", 60, 0));
  const auto ready = CoachesOf(stage, {MethodOf("at-first-mistake")});
  Mimic player(stage, EveryRepetition(stage));
  const SessionLog log = SessionWith(ready[0], world, player);
  // When a mistake is judged, the next repetition has already begun; the correction cuts it off.
  for (const LoggedPerformance& performance : log.performances) {
    EXPECT_GT(performance.judged.end_frame - performance.judged.begin_frame, 40);
  }
}

TEST(CoachSession, GivesTheSameWhateverWasRunBefore) {
  const CoachStage& stage = StageOf("sprint");
  const CoachWorld world = WorldOf(ConditionOf("sprint", 60, 1));
  const auto both = CoachesOf(stage, {MethodOf("at-first-mistake"), MethodOf("after-n")});
  const auto alone = CoachesOf(stage, {MethodOf("after-n")});
  Mimic first(stage, {1, 2, 3}), second(stage, {1, 2, 3}), third(stage, {1, 2, 3});
  SessionWith(both[0], world, first);
  const SessionLog after = SessionWith(both[1], world, second), fresh = SessionWith(alone[0], world, third);
  ASSERT_EQ(after.Frames(), fresh.Frames());
  EXPECT_EQ(after.modes, fresh.modes);
  for (int frame = 0; frame < after.Frames(); ++frame) {
    const auto t = static_cast<std::size_t>(frame);
    ASSERT_EQ(after.coach.poses[t].joints, fresh.coach.poses[t].joints);
    ASSERT_EQ(after.sensed.frames[t][Role::kLeftHand].position, fresh.sensed.frames[t][Role::kLeftHand].position);
  }
}

TEST(CoachSession, HEAVY_SeesByCamerasWhoseEveryStageIsTrueWhatAPerfectSensorSees) {
  const CoachStage& stage = StageOf("groove");
  CoachCondition condition = ConditionOf("groove", 12, 0);
  const CoachWorld perfect = WorldOf(condition);
  condition.sight.has_cameras = true;
  condition.sight.cameras.studio.picture_every = 2;
  const CoachWorld cameras = WorldOf(condition);
  CoachMethod method = MethodOf("at-first-mistake");
  CaptureMethod& capture = method.sight.capture.emplace();
  capture.causal = true;
  capture.oracle = {true, true, true, true, true, true, true, true};
  const auto ready = CoachesOf(stage, {method});
  Mimic first(stage, {1}), second(stage, {1});
  const SessionLog log = SessionWith(ready[0], cameras, first), wanted = SessionWith(ready[0], perfect, second);
  ASSERT_EQ(log.performances.size(), wanted.performances.size());
  ASSERT_GT(log.performances.size(), 1u);
  for (std::size_t i = 0; i < log.performances.size(); ++i) {
    EXPECT_EQ(log.performances[i].judged.called_right, wanted.performances[i].judged.called_right) << i;
    EXPECT_EQ(log.performances[i].judged.called_wrong.has_value(), wanted.performances[i].judged.called_wrong.has_value());
  }
  for (std::size_t t = 0; t < 60; t += 2) {  // frames between these repeat the last skeleton
    const BodyPose seen = PoseOf(log.sensed.frames[t]);
    for (const Role role : AllRoles()) {
      ASSERT_LT(glm::distance(seen[role], log.learner.poses[t][role]), 1e-3) << t << RoleName(role);
    }
  }
}

class At final : public MomentSource {
 public:
  explicit At(std::vector<int> frames) : frames_(std::move(frames)) {}
  bool Now(int frame, const CoachOutput&) override { return std::ranges::find(frames_, frame) != frames_.end(); }

 private:
  std::vector<int> frames_;
};

TEST(CoachSession, AYokedCoachCorrectsAtGivenMomentsWhateverItSees) {
  const CoachStage& stage = StageOf("groove");
  const CoachWorld world = WorldOf(ConditionOf("groove", 60, 0));
  const auto ready = CoachesOf(stage, {MethodOf("yoked")});
  Mimic player(stage);
  At moments({300, 1200});
  const SessionLog log = SessionWith(ready[0], world, player, &moments);
  ASSERT_EQ(log.corrections.size(), 2u);
  EXPECT_NEAR(log.corrections[0].decided_frame, 300, 2);
  EXPECT_GE(log.corrections[1].decided_frame, 1200);
  EXPECT_EQ(TallyOf(log).unneeded, 2);
}

TEST(CoachSession, HasTheSensorThatASessionRecordedWouldHave) {
  const CoachStage& stage = StageOf("groove");
  const CoachWorld world = WorldOf(ConditionOf("groove", 20, 1));
  const auto ready = CoachesOf(stage, {MethodOf("at-first-mistake")});
  Mimic player(stage);
  const SessionLog log = SessionWith(ready[0], world, player);
  BodyMotion danced = log.learner;  // without the poses planned beyond the end, so the last reports may differ
  const SkeletonStream whole = SenseSkeleton(danced, world.sensor, world.occluders, world.errors, world.key);
  for (std::size_t t = 0; t + SkeletonSensor::kAhead < log.sensed.frames.size(); ++t) {
    for (const Role role : AllRoles()) {
      ASSERT_EQ(log.sensed.frames[t][role].position, whole.frames[t][role].position) << "frame " << t;
    }
  }
}

}  // namespace
}  // namespace etude
