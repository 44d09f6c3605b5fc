#include "bench/tasks/coach/operating_point.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "bench/tasks/coach/learner_player.h"
#include "tests/bench/tasks/coach/coach_fixture.h"

namespace etude {
namespace {

TEST(ThresholdOf, BearsSoManyRightPerformancesBelowIt) {
  const std::vector<double> right = {0.4, 0.1, 0.3, 0.2};
  EXPECT_EQ(ThresholdOf(right, 10, 0), 0.1);
  EXPECT_EQ(ThresholdOf(right, 10, 0.2), 0.3);  // two alarms in ten minutes
  EXPECT_EQ(ThresholdOf(right, 10, 0.29), 0.3);
  EXPECT_EQ(ThresholdOf(right, 10, 1), 1);  // all alarms are allowed
}

CoachCondition AtOperatingPoint(double needless_per_min, int sessions) {
  CoachCondition condition = ConditionOf("groove", 60, 1);
  condition.operating_point = CoachOperatingPoint{needless_per_min, sessions};
  return condition;
}

double ThresholdSet(const CoachCondition& condition, const WorldKey& key, CoachMethod method) {
  std::vector<CoachMethod> methods = {std::move(method)};
  EXPECT_TRUE(SetThresholds(condition, StageOf("groove"), key, methods));
  return methods.front().sight.threshold.value_or(-1);
}

TEST(SetThresholds, KeepsItsPromiseOnThePeopleItWasSetOn) {
  const CoachCondition condition = AtOperatingPoint(1, 3);
  const CoachStage& stage = StageOf("groove");
  const double threshold = ThresholdSet(condition, {1, "coach-test", 5}, MethodOf("at-first-mistake", "dtw"));
  const auto recogniser = MakeRecogniser({.kind = FindRecogniser("dtw")}, stage.taught);
  const auto watching = MakeWatching(stage);
  int below = 0, at = 0;
  for (int trial = 0; trial < 3; ++trial) {
    const CoachWorld world = MakeCoachWorld(condition, {1, "coach-test/operating-point", trial});
    const auto log = RunMethod(*watching, condition, stage, world, nullptr);
    FollowPerformances(*log, **recogniser, {}, [&](const LoggedPerformance& performance, double evidence) {
      const bool is_right = performance.judged.truth == PerformanceTruth::kRight;
      below += is_right && evidence < threshold;
      at += is_right && evidence == threshold;
    });
  }
  EXPECT_EQ(below, 3);  // one alarm in each minute
  EXPECT_GE(at, 1);     // one more alarm would exceed the limit
}

TEST(SetThresholds, IsTheSameForAllWorldsAndFallsWithWhatIsBorne) {
  const CoachMethod method = MethodOf("at-first-mistake", "dtw");
  const double here = ThresholdSet(AtOperatingPoint(1, 2), {1, "coach-test", 0}, method);
  EXPECT_EQ(here, ThresholdSet(AtOperatingPoint(1, 2), {1, "coach-test", 7}, method));
  EXPECT_GT(here, ThresholdSet(AtOperatingPoint(0, 2), {1, "coach-test", 0}, method));
}

TEST(SetThresholds, LeavesWhoSaysHisOwnOrIsToldTheTruth) {
  CoachMethod own = MethodOf("at-first-mistake", "dtw");
  own.sight.threshold = 0.77;
  EXPECT_EQ(ThresholdSet(AtOperatingPoint(1, 1), {1, "coach-test", 0}, own), 0.77);
  EXPECT_EQ(ThresholdSet(AtOperatingPoint(1, 1), {1, "coach-test", 0}, MethodOf("oracle")), -1);
}

TEST(FollowPerformances, ComesToTheEvidenceThatTheSessionCameTo) {
  const CoachStage& stage = StageOf("groove");
  const CoachCondition condition = ConditionOf("groove", 45, 1);
  const CoachWorld world = MakeCoachWorld(condition, {1, "coach-test", 0});
  CoachMethod method = MethodOf("never", "dtw");
  method.sight.threshold = 2;  // nothing is judged before its window has closed
  const auto ready = CoachesOf(stage, {method});
  const auto log = RunMethod(ready.front(), condition, stage, world, nullptr);
  std::vector<double> live, followed;
  for (const CoachRecord& record : log->records) {
    if (record.event == CoachEvent::kWrong) live.push_back(record.evidence);
  }
  FollowPerformances(*log, *ready.front().recogniser, {},
                     [&](const LoggedPerformance&, double evidence) { followed.push_back(evidence); });
  EXPECT_GT(live.size(), 5u);
  EXPECT_EQ(live, followed);
}

}  // namespace
}  // namespace etude
