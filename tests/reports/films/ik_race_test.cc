#include "reports/films/ik_race.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/films/race_run.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

Result<IkRace> Find(const RunData& run) { return FindIkRace(run, run.scenarios.front()); }

std::string WhyNone(const RunData& run) { return testing::Refusal(Find(run)); }

TEST(IkRace, IsTheFirstWorldThatRecordedBothWhoeverLooksBestLater) {
  ASSERT_OK(race, Find(RaceRun({{"slow", 0, 0.01, EveryIteration(50), Status::kUnsolved, "14° after 50 sweeps"},
                                {"quick", 0, 0.01, EveryIteration(60), Status::kUnsolved, "12° after 60 sweeps"},
                                {"slow", 1, 0.5, EveryIteration(15)},
                                {"quick", 1, 1, EveryIteration(8)}})));
  EXPECT_EQ(race->world, "trial 0");
  EXPECT_EQ(race->choice, "the first world with recordings of both methods");
  EXPECT_EQ(race->paths[0].method, "slow");
  EXPECT_EQ(race->paths[1].method, "quick");
}

TEST(IkRace, SaysWhichWorldItPassedOver) {
  ASSERT_OK(race, Find(RaceRun({{"slow", 0, 0.1, EveryIteration(60)},
                                {"quick", 0, 1, {}, Status::kCrashed, "its process died"},
                                {"slow", 1, 0.1, EveryIteration(60)},
                                {"quick", 1, 1, EveryIteration(8)}})));
  EXPECT_EQ(race->world, "trial 1");
  EXPECT_THAT(race->choice,
              HasSubstr("1 world had recordings of only one method, the first of them trial 0 (quick: crashed)"));
}

TEST(IkRace, TakesTheFirstTwoOfTheMethodsThatWereRecorded) {
  ASSERT_OK(race, Find(RaceRun({{"a", 0, 1, {}},
                                {"b", 0, 1, EveryIteration(8)},
                                {"c", 0, 1, EveryIteration(8)},
                                {"d", 0, 1, EveryIteration(8)}})));
  EXPECT_EQ(race->paths[0].method, "b");
  EXPECT_EQ(race->paths[1].method, "c");
}

TEST(IkRace, SaysWhyThereIsNone) {
  EXPECT_THAT(WhyNone(RaceRun({{"a", 0, 1, {}}, {"b", 0, 1, {}}})), HasSubstr("kept no recordings of this scenario"));
  EXPECT_THAT(WhyNone(RaceRun({{"a", 0, 1, EveryIteration(3)}, {"b", 0, 1, {}}})), HasSubstr("only one method"));
  EXPECT_THAT(WhyNone(RaceRun({{"a", 0, 1, EveryIteration(3)},
                               {"b", 0, 1, {}, Status::kFailed},
                               {"a", 1, 1, {}, Status::kFailed},
                               {"b", 1, 1, EveryIteration(3)}})),
              HasSubstr("no world has recordings of both a and b"));
  EXPECT_EQ(WhyNone(RaceRun({{"a", 0, 1, EveryIteration(3)}, {"b", 0, 1, EveryIteration(3)}})), "accepted");
}

TEST(IkRace, KnowsWhatEachMethodHasReachedAtAMoment) {
  ASSERT_OK(race, Find(RaceRun({{"long", 0, 0.1, {0, 1, 2, 10, 100}}, {"short", 0, 1, {0, 1, 2, 3}}})));
  EXPECT_EQ(race->LastIteration(), 100);
  const IkPath &sparse = race->paths[0], &ended = race->paths[1];
  EXPECT_EQ(sparse.EntryAt(0), 0u);
  EXPECT_EQ(sparse.EntryAt(1.999), 1u);
  EXPECT_EQ(sparse.EntryAt(9.999), 2u);
  EXPECT_EQ(sparse.EntryAt(10), 3u);
  EXPECT_EQ(sparse.EntryAt(100), 4u);
  EXPECT_EQ(ended.EntryAt(2.5), 2u);
  EXPECT_EQ(ended.EntryAt(100), 3u);
}

TEST(IkRace, IsSolvedOnceBothErrorsStayBelowTheGoal) {
  // 40° · e^(−i) first falls below 0.1° at i = 6, and so does 20 cm · e^(−i) below 0.1 cm.
  ASSERT_OK(race, Find(RaceRun({{"tight", 0, 1, EveryIteration(12)},
                                {"broken", 0, 1, EveryIteration(12), Status::kUnsolved, "2 angles outside"}})));
  EXPECT_EQ(race->paths[0].solved_at, 6);
  EXPECT_EQ(race->paths[0].ending, "solved");
  EXPECT_FALSE(race->paths[1].solved_at.has_value());
  EXPECT_EQ(race->paths[1].ending, "not solved");
  EXPECT_EQ(race->paths[1].reason, "2 angles outside");
}

TEST(IkRace, KnowsWhereTheEndsShouldBeWhateverTheTruth) {
  RunData run = RaceRun({{"a", 0, 1, EveryIteration(2)}, {"b", 0, 1, EveryIteration(2)}});
  const auto with = [&](const std::string& targets) {
    run.recordings[0].recording.extras_json =
        R"({"iterations": [0, 1, 2], "position_error_max_cm": [3, 2, 1], "axis_error_max_deg": [0, 0, 0],
            "targets_m": )" +
        targets + "}";
    return Find(run);
  };
  ASSERT_OK(race, with("[[0.1, 2, 0.3], null, [0, 0, 0], [1, 1, 1]]"));
  EXPECT_EQ(race->targets[0], glm::dvec3(0.1, 2, 0.3));
  EXPECT_FALSE(race->targets[1].has_value());
  EXPECT_EQ(race->targets[3], glm::dvec3(1));
  for (const char* bad : {"null", "[null, null, null]", "[null, null, null, 1]", "[null, null, null, [1, 2]]",
                          R"([null, null, null, [1, 2, "up"]])"}) {
    EXPECT_THAT(testing::Refusal(with(bad)), HasSubstr("'targets_m' in the extras is not a list of 4 positions"))
        << bad;
  }
}

TEST(IkRace, KnowsThatWithoutErrorsNothingWasAskedFor) {
  EXPECT_FALSE(IsAskedFor({0, 0, 0}));
  EXPECT_TRUE(IsAskedFor({12, 0, 0}));
}

TEST(IkRace, RefusesRecordingsThatDoNotSayWhatTheyShow) {
  const RunData good = RaceRun({{"a", 0, 1, EveryIteration(2)}, {"b", 0, 1, EveryIteration(2)}});
  const auto complaint = [&](const std::string& extras) {
    RunData run = good;
    run.recordings[1].recording.extras_json = extras;
    return WhyNone(run);
  };
  const std::string errors = R"(, "position_error_max_cm": [3, 2, 1], "axis_error_max_deg": [3, 2, 1]})";
  EXPECT_EQ(complaint(R"({"iterations": [0, 1, 2])" + errors), "accepted");
  EXPECT_THAT(complaint("{}"),
              HasSubstr("race/-/000/b: 'iterations' in the extras is not a list of 3 increasing whole numbers"));
  EXPECT_THAT(complaint("[]"), HasSubstr("not a JSON object"));
  EXPECT_THAT(complaint(R"({"iterations": [0, 1])" + errors),
              HasSubstr("'iterations' in the extras is not a list of 3"));
  EXPECT_THAT(complaint(R"({"iterations": [0, 1, "2"])" + errors),
              HasSubstr("'iterations' in the extras is not a list of 3"));
  for (const char* wrong : {"[0, 2, 1]", "[1, 2, 3]", "[0, 1, 1.5]", "[0, 1, 1e12]"}) {
    EXPECT_THAT(complaint(R"({"iterations": )" + std::string(wrong) + errors),
                HasSubstr("increasing whole numbers from 0"))
        << wrong;
  }
  EXPECT_THAT(complaint(R"({"iterations": [0, 1, 2], "position_error_max_cm": [3, -2, 1]})"),
              HasSubstr("'position_error_max_cm' in the extras is not a list of 3 numbers of at least 0"));
}

}  // namespace
}  // namespace etude
