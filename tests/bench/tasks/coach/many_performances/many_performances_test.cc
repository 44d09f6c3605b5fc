// Before a sensor without errors nobody who makes no mistake is corrected, and nobody is praised for standing there.
#include <gtest/gtest.h>
#include <cstdlib>

#include "bench/tasks/coach/learner_player.h"
#include "sim/choreography/song.h"
#include "tests/bench/tasks/coach/coach_fixture.h"

namespace etude {
namespace {

const int kPerformances = std::getenv("NP") ? std::atoi(std::getenv("NP")) : 10000;

struct Count {
  int performances = 0, right = 0, wrong = 0, corrections = 0, praised = 0;
};

/// Sessions of one person after another, song by song, until they have performed often enough.
Count Sessions(const char* recogniser, const char* policy, double seconds, const CoachCondition& people) {
  Count count;
  for (int trial = 0; count.performances < kPerformances; ++trial) {
    for (const std::string& song : BuiltinSongNames()) {
      CoachCondition condition = people;
      condition.song = song;
      condition.session_s = seconds;
      condition.sight.noise = 0;
      const CoachStage& stage = StageOf(song);
      const CoachWorld world = WorldOf(condition, trial);
      static std::map<std::string, std::vector<ReadyCoach>> coaches;
      std::vector<ReadyCoach>& ready = coaches[song + recogniser + policy];
      if (ready.empty()) ready = CoachesOf(stage, {MethodOf(policy, recogniser)});
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

TEST(ManyPerformances, APerfectLearnerIsNeverCorrected) {
  CoachCondition perfect = PeopleOf(People::kExpert);
  perfect.learner.skill = 1;
  const Count count = Sessions(std::getenv("RE"), "at-first-mistake", 180, perfect);
  EXPECT_EQ(count.right, count.performances);
  EXPECT_EQ(count.corrections, 0) << "of " << count.performances;
  EXPECT_EQ(count.praised, count.performances);
}

TEST(ManyPerformances, NobodyIsPraisedForStandingThere) {
  constexpr double kBeforeTheCoachTiresOfIt = 29;  // seconds
  const Count count = Sessions("dtw", "never", kBeforeTheCoachTiresOfIt, PeopleOf(People::kAbsent));
  EXPECT_EQ(count.wrong, count.performances);
  EXPECT_EQ(count.praised, 0) << "of " << count.performances;
}

// The control: who has no skill is corrected, and a coach who takes anything for right praises the absent.
TEST(ManyPerformances, TheCountsCanBeOtherwise) {
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
