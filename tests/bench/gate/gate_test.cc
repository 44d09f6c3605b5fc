#include "bench/gate/gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bench/gate/example.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

FinishedRun Steady(const std::string& extra = "") {
  return ExampleRun([](int trial, const std::string&) { return ExampleResult(trial); }, extra);
}

FinishedRun Worse(const std::string& extra = "") {
  return ExampleRun([](int trial, const std::string& method) { return ExampleResult(trial, method == "b" ? 1 : 0); },
                    extra);
}

GateVerdict VerdictOn(const FinishedRun& run, const Snapshot& baseline) {
  const auto report = JudgeRun(run, &baseline, "b.json");
  EXPECT_TRUE(report) << ToString(report.error());
  return report ? GateVerdictOf(*report) : GateVerdict::kPassed;
}

TEST(Gate, PassesARerunAndStopsARegression) {
  const Snapshot baseline = TakeSnapshot(Steady());
  EXPECT_EQ(VerdictOn(Steady(), baseline), GateVerdict::kPassed);
  EXPECT_EQ(VerdictOn(Worse(), baseline), GateVerdict::kRegressed);
}

TEST(Gate, LetsAnImprovementPassUnlessTheRuleIsExact) {
  const std::string exact = "gate: {rule: exact}\n";
  EXPECT_EQ(VerdictOn(Steady(), TakeSnapshot(Worse())), GateVerdict::kPassed);
  EXPECT_EQ(VerdictOn(Steady(exact), TakeSnapshot(Worse(exact))), GateVerdict::kRegressed);
  EXPECT_EQ(VerdictOn(Steady(exact), TakeSnapshot(Steady(exact))), GateVerdict::kPassed);
}

TEST(Gate, ComparesOnlyTheMetricsThatItsRulesName) {
  const std::string shares = "gate: {metrics: [solved_practical]}\n";
  EXPECT_EQ(VerdictOn(Worse(shares), TakeSnapshot(Steady(shares))), GateVerdict::kPassed);
  EXPECT_EQ(TakeSnapshot(Steady(shares)).scenarios[0].metrics.size(), 1u);
}

TEST(Gate, FailsOnAnUnmetExpectationWithoutAnyBaseline) {
  FinishedRun run = Steady();
  run.data.scenarios[0].expectations = {{"a below b", ClaimOutcome::kUndecided, "few"}};
  EXPECT_EQ(GateVerdictOf(*JudgeRun(run, nullptr, "")), GateVerdict::kPassed);
  run.data.scenarios[0].expectations[0].outcome = ClaimOutcome::kUnmet;
  EXPECT_EQ(GateVerdictOf(*JudgeRun(run, nullptr, "")), GateVerdict::kRegressed);
}

TEST(Gate, RefusesABaselineOfOtherWorldsAndSaysWhatDiffers) {
  Snapshot baseline = TakeSnapshot(Steady());
  baseline.scenarios[0].seed = 9;
  EXPECT_THAT(testing::Refusal(JudgeRun(Steady(), &baseline, "b.json")),
              HasSubstr("b.json: this baseline and the run have different worlds: s: the seed was 9 and is 5"));
}

TEST(Gate, DoesNotJudgeARunThatLacksRows) {
  const Snapshot baseline = TakeSnapshot(Steady());
  FinishedRun run = Worse();
  run.data.rows.erase(run.data.rows.begin() + 7);
  ASSERT_TRUE(CheckRows(run, {"cells.jsonl", 0, 0}));
  EXPECT_THAT(run.incomplete, ElementsAre("s: 1 of 96 rows are missing; the first missing row is "
                                          "s/joint_noise_deg=1/003/b"));
  EXPECT_EQ(VerdictOn(run, baseline), GateVerdict::kIncomplete);
  FinishedRun whole = Worse();
  ASSERT_TRUE(CheckRows(whole, {}));
  EXPECT_THAT(whole.incomplete, IsEmpty());
}

TEST(Gate, RefusesRowsThatAreThereTwiceOrThatNobodyAskedFor) {
  FinishedRun twice = Steady();
  twice.data.rows.push_back(twice.data.rows[3]);
  EXPECT_THAT(ToString(CheckRows(twice, {"cells.jsonl", 0, 0}).error()),
              HasSubstr("contains the cell s/joint_noise_deg=1/001/b twice"));
  FinishedRun stranger = Steady();
  stranger.data.rows[3].method = "c";
  EXPECT_THAT(ToString(CheckRows(stranger, {}).error()), HasSubstr("/c, but no scenario of the manifest has this "
                                                                   "cell"));
}

TEST(Gate, IsIncompleteWhereTheMachineEndedACell) {
  const Snapshot baseline = TakeSnapshot(Steady());
  for (Status status : {Status::kTimeout, Status::kCrashed, Status::kOutOfMemory}) {
    FinishedRun run = Steady();
    run.data.rows[5].result = CellResult::Ended(status, "signal 9");
    EXPECT_EQ(VerdictOn(run, baseline), GateVerdict::kIncomplete);
    EXPECT_THAT(WhyIncomplete(run), ElementsAre(HasSubstr("s/joint_noise_deg=1/002/b: signal 9")));
  }
  EXPECT_THAT(WhyIncomplete(Steady()), IsEmpty());
}

TEST(Gate, FailsAMethodThatGaveNoAnswerAnywhere) {
  FinishedRun run = Steady();
  for (Row& row : run.data.rows) {
    if (row.method == "b") row.result = CellResult::Ended(Status::kFailed, "ended with exit code 1");
  }
  const auto report = JudgeRun(run, nullptr, "");
  EXPECT_EQ(GateVerdictOf(*report), GateVerdict::kRegressed);
  EXPECT_THAT(report->silent, ElementsAre("s: none of the 48 cells of b has an answer; the first cell "
                                          "is s/joint_noise_deg=1/000/b; 48 × failed: ended with exit code 1"));
  run.data.rows.back().result = CellResult::Ended(Status::kUnsolved, "too far");  // b's; an answer
  EXPECT_EQ(GateVerdictOf(*JudgeRun(run, nullptr, "")), GateVerdict::kPassed);
  // A cell whose program answered `no_answer` is unsolved, too, but it is no answer.
  run.data.rows.back().result = CellResult::Ended(Status::kUnsolved, "gave no answer: 'no'");
  EXPECT_EQ(GateVerdictOf(*JudgeRun(run, nullptr, "")), GateVerdict::kRegressed);
}

TEST(Gate, IsIncompleteWhereNothingWasRun) {
  FinishedRun run = Steady();
  for (Row& row : run.data.rows) row.result = CellResult::Ended(Status::kSkipped, "no labels");
  const auto report = JudgeRun(run, nullptr, "");
  EXPECT_EQ(GateVerdictOf(*report), GateVerdict::kIncomplete);
  EXPECT_THAT(report->incomplete,
              ElementsAre("every cell was skipped; the first cell is s/joint_noise_deg=1/000/a: no labels"));
}

TEST(Gate, IsIncompleteWhenTheBaselineHoldsMoreThanTheRun) {
  const Snapshot baseline = TakeSnapshot(Steady());
  Snapshot more = baseline;
  more.scenarios.push_back(more.scenarios[0]);
  more.scenarios[1].name = "gone";
  EXPECT_EQ(VerdictOn(Steady(), more), GateVerdict::kIncomplete);
  Snapshot less = baseline;
  less.scenarios[0].cells.pop_back();
  EXPECT_EQ(VerdictOn(Steady(), less), GateVerdict::kPassed);
}

TEST(Gate, FailsIfAnAnswerFlipsAlthoughNoMethodGotWorse) {
  // b is 1 cm better than a. Then a improves by `gain` (cm), and b stays the same.
  const auto run = [](double gain) {
    return ExampleRun([gain](int trial, const std::string& method) {
      return ExampleResult(trial, method == "b" ? -1 + 0.01 * (trial % 3) : -gain);
    });
  };
  const Snapshot baseline = TakeSnapshot(run(0));
  const auto fallen_of = [&](double gain) {
    const auto report = JudgeRun(run(gain), &baseline, "b.json");
    EXPECT_TRUE(std::ranges::none_of(report->comparison.moves, IsRegression));
    std::vector<std::string> told;
    for (const WorsenedAnswer& one : report->worsened) told.push_back(DescribeWorsened(one));
    return std::pair(told, GateVerdictOf(*report));
  };
  EXPECT_THAT(fallen_of(2), testing::Pair(ElementsAre("s, joint_noise_deg=1: b against a: better before, now worse",
                                                      "s, joint_noise_deg=2: b against a: better before, now worse"),
                                          GateVerdict::kRegressed));
  // If the verdict becomes "no difference", the gate reports it but passes. If method a improves by less than that, the
  // verdict does not change.
  EXPECT_THAT(fallen_of(0.99), testing::Pair(ElementsAre(HasSubstr("b against a: better before, now no difference"),
                                                         HasSubstr("b against a: better before, now no difference")),
                                             GateVerdict::kPassed));
  EXPECT_THAT(fallen_of(0.5), testing::Pair(IsEmpty(), GateVerdict::kPassed));
  EXPECT_THAT(fallen_of(0), testing::Pair(IsEmpty(), GateVerdict::kPassed));
}

TEST(Gate, ReadsNoAnswersFromABaselineThatLacksWhatTheyAreMadeOf) {
  const std::string shares = "gate: {metrics: [solved_practical]}\n";
  const auto run = [&](double gain) {
    return ExampleRun(
        [gain](int trial, const std::string& method) { return ExampleResult(trial, method == "b" ? -1 : -gain); },
        shares);
  };
  const Snapshot baseline = TakeSnapshot(run(0));
  EXPECT_EQ(VerdictOn(run(2), baseline), GateVerdict::kPassed);
}

FinishedRun Timed(double ratio, int worlds) {
  FinishedRun run = Steady("gate: {time_ratios: [{of: b, over: a, at_most: 2}]}\n");
  for (const Row& row : run.data.rows) {
    if (row.trial >= worlds) continue;
    const double world = 1 + row.trial;  // worlds differ in size, so the ratio must be taken per world
    run.data.cpu_seconds[row.Id()] = row.method == "a" ? world : world * (ratio + 0.01 * (row.trial % 5));
  }
  return run;
}

TEST(TimeRatios, AreJudgedByTheIntervalOfPairedRatios) {
  const auto outcome = [](double ratio, int worlds = 24) { return JudgeTimeRatios(Timed(ratio, worlds))[0].outcome; };
  EXPECT_EQ(outcome(1.5), ClaimOutcome::kMet);
  EXPECT_EQ(outcome(2.5), ClaimOutcome::kUnmet);
  EXPECT_EQ(outcome(2.5, 2), ClaimOutcome::kUndecided);  // four worlds under two conditions
  EXPECT_EQ(outcome(1.985), ClaimOutcome::kUndecided);   // the median exceeds the limit, the interval contains it
  EXPECT_EQ(outcome(2.5, 0), ClaimOutcome::kUndecided);
  EXPECT_EQ(GateVerdictOf(*JudgeRun(Timed(2.5, 24), nullptr, "")), GateVerdict::kRegressed);
  EXPECT_EQ(GateVerdictOf(*JudgeRun(Timed(1.5, 24), nullptr, "")), GateVerdict::kPassed);
}

TEST(TimeRatios, AreUndecidedIfAMethodIsTooShortToTime) {
  const auto judged = [](double scale) {
    FinishedRun run = Timed(3, 24);
    for (auto& [id, seconds] : run.data.cpu_seconds) seconds *= scale;
    return JudgeTimeRatios(run)[0];
  };
  // The median time of method a is 12.5 × scale, in seconds.
  const RatioResult brief = judged(0.0001 / 12.5), long_enough = judged(0.0004 / 12.5);
  EXPECT_EQ(brief.outcome, ClaimOutcome::kUndecided);
  EXPECT_NEAR(brief.too_short_s.value_or(0), 0.0003, 1e-5) << "three times the time of a";
  FinishedRun few = Timed(3, 1);
  for (auto& [id, seconds] : few.data.cpu_seconds) seconds *= 1e-5;
  EXPECT_TRUE(JudgeTimeRatios(few)[0].too_short_s) << "also without an interval";
  EXPECT_EQ(long_enough.outcome, ClaimOutcome::kUnmet);
  EXPECT_EQ(long_enough.too_short_s, std::nullopt);
}

TEST(TimeRatios, LeaveOutCellsThatEndedBecauseOfTheMachine) {
  FinishedRun run = Timed(1.5, 24);
  run.data.rows[1].result.status = Status::kTimeout;
  EXPECT_EQ(JudgeTimeRatios(run)[0].pairs, 47);
}

}  // namespace
}  // namespace etude
