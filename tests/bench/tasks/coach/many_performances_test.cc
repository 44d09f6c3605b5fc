// With an ideal sensor, a person without mistakes is never corrected, and a person who stands still is never praised.
#include <gtest/gtest.h>

#include "bench/tasks/coach/learner_player.h"
#include "sim/choreography/song.h"
#include "tests/bench/tasks/coach/coach_fixture.h"

namespace etude {
namespace {

constexpr int kPerformances = 10000;

struct Count {
  int performances = 0, right = 0, wrong = 0, corrections = 0, praised = 0;
};

/// Runs sessions of successive people, song by song, until there are enough performances. Returns the counts.
Count Sessions(const char* policy, double seconds, const CoachCondition& people) {
  CoachMethod method = MethodOf(policy, "dtw");
  method.sight.threshold = 0.3;  // as in the scenarios, where it was set on other people
  std::map<std::string, std::vector<ReadyCoach>> coaches;
  Count count;
  for (int trial = 0; count.performances < kPerformances; ++trial) {
    for (const std::string& song : BuiltinSongNames()) {
      CoachCondition condition = people;
      condition.song = song;
      condition.session_s = seconds;
      condition.sight.noise = 0;
      const CoachStage& stage = StageOf(song);
      const CoachWorld world = WorldOf(condition, trial);
      std::vector<ReadyCoach>& ready = coaches[song];
      if (ready.empty()) ready = CoachesOf(stage, {method});
      LearnerPlayer player(world, stage);
      const SessionLog log = SessionWith(ready.front(), world, player);
      count.corrections += static_cast<int>(log.corrections.size());
      for (const LoggedPerformance& performance : log.performances) {
        ++count.performances;
        count.right += performance.judged.truth == PerformanceTruth::kRight;
        count.wrong += performance.judged.truth == PerformanceTruth::kWrong;
        count.praised += performance.judged.called_right;
      }
    }
  }
  return count;
}

CoachCondition PeopleOf(People kind) {
  CoachCondition condition;
  condition.sight.session.people = kind;
  return condition;
}

TEST(ManyPerformances, HEAVY_APerfectLearnerIsNeverCorrected) {
  CoachCondition perfect = PeopleOf(People::kExpert);
  perfect.learner.skill = 1;
  const Count count = Sessions("at-first-mistake", 180, perfect);
  EXPECT_EQ(count.right, count.performances);
  EXPECT_EQ(count.corrections, 0) << "of " << count.performances;
  EXPECT_EQ(count.praised, count.performances);
}

TEST(ManyPerformances, HEAVY_NobodyIsPraisedForStandingThere) {
  constexpr double kBeforeTheCoachTiresOfIt = 29;  // seconds
  const Count count = Sessions("never", kBeforeTheCoachTiresOfIt, PeopleOf(People::kAbsent));
  EXPECT_EQ(count.wrong, count.performances);
  EXPECT_EQ(count.praised, 0) << "of " << count.performances;
}

// The controls: a person without skill is corrected, and a coach with a very low threshold praises this person.
TEST(ManyPerformances, HEAVY_TheCountsCanBeOtherwise) {
  CoachCondition clumsy = PeopleOf(People::kMixed);
  clumsy.learner.skill = 0;
  clumsy.song = "groove";
  clumsy.session_s = 60;
  clumsy.sight.noise = 0;
  const CoachStage& stage = StageOf("groove");
  const CoachWorld world = WorldOf(clumsy);
  LearnerPlayer player(world, stage);
  EXPECT_FALSE(
      SessionWith(CoachesOf(stage, {MethodOf("at-first-mistake", "dtw")}).front(), world, player).corrections.empty());
}

}  // namespace
}  // namespace etude
