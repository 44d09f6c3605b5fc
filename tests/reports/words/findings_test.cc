#include "reports/words/findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/reports/support/example_run.h"
#include "tests/reports/support/unit_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Comparison Figures(int pairs, std::optional<double> difference, std::optional<double> low, std::optional<double> high,
                   double share_better, Verdict verdict) {
  Comparison comparison;
  comparison.pairs = pairs;
  comparison.difference = difference;
  comparison.ci_low = low;
  comparison.ci_high = high;
  comparison.share_better = share_better;
  comparison.better = static_cast<int>(std::lround(share_better * pairs));
  comparison.worse = pairs - comparison.better;
  comparison.verdict = verdict;
  return comparison;
}

ScenarioSummary OneComparison(Comparison comparison, std::vector<std::string> methods = {"fixed", "adaptive"}) {
  comparison.metric = "orientation_error_deg";
  comparison.baseline = "fixed";
  comparison.method = "adaptive";
  ScenarioSummary scenario{.name = "one", .methods = std::move(methods), .headline_metrics = {"orientation_error_deg"}};
  scenario.conditions.emplace_back().comparisons = {comparison};
  return scenario;
}

std::string AnswerTo(const Comparison& comparison) {
  return FindingsOf(RunData{}, OneComparison(comparison)).answer.sentence;
}

TEST(Answer, SaysHowMuchBetterOnHowManyWorlds) {
  EXPECT_EQ(AnswerTo(Figures(60, -12.3, -14.0, -10.1, 58.0 / 60, Verdict::kBetter)),
            "“adaptive” lowers the effector orientation error by 12.3° (95 % CI 10.1–14.0) against “fixed”; the "
            "difference matters in 58 of 60 worlds.");
}

TEST(Answer, CountsTheWorldsLostWhenWorse) {
  EXPECT_THAT(AnswerTo(Figures(20, 3.0, 2.0, 4.0, 0.1, Verdict::kWorse)),
              HasSubstr("raises the effector orientation error by 3.00° (95 % CI 2.00–4.00) against “fixed”; the "
                        "difference matters in 18 of 20 worlds."));
}

TEST(Answer, ClaimsNothingThatIsNotSettled) {
  const std::string open = AnswerTo(Figures(20, -0.2, -0.9, 0.5, 0.5, Verdict::kUndecided));
  EXPECT_THAT(open, HasSubstr("It is undecided whether"));
  EXPECT_THAT(open, Not(HasSubstr("lowers")));
  const std::string same = AnswerTo(Figures(20, 0.01, -0.02, 0.03, 0.5, Verdict::kNoDifference));
  EXPECT_THAT(same, HasSubstr("makes no difference that matters"));
}

TEST(Answer, NamesTheMeanThatTheMedianHides) {
  Comparison rare = Figures(120, 0, 0, 0, 0.4, Verdict::kUndecided);
  rare.mean = 6.3, rare.mean_low = 3.19, rare.mean_high = 9.61;
  EXPECT_THAT(AnswerTo(rare), HasSubstr("median 0° (95 % CI 0–0), mean 6.30° (3.19–9.61) on 120 worlds"));
  rare.verdict = Verdict::kNoDifference;
  EXPECT_THAT(AnswerTo(rare), Not(HasSubstr("mean")));
}

TEST(Answer, SaysWhyItIsOpen) {
  Comparison open = Figures(8, -4.7, -6.0, -1.1, 0.9, Verdict::kUndecided);
  open.why_open = "too few worlds";
  EXPECT_THAT(AnswerTo(open), ::testing::EndsWith("on 8 worlds. Why: too few worlds."));
}

TEST(Answer, TellsOfTheWorldsThatOnlyOneSurvived) {
  Comparison lossy = Figures(40, -4.7, -6.0, -1.1, 0.9, Verdict::kBetter);
  EXPECT_THAT(AnswerTo(lossy), Not(HasSubstr("The difference does not include")));
  lossy.only_baseline = 13;
  lossy.only_method = 1;
  EXPECT_THAT(
      AnswerTo(lossy),
      HasSubstr("The difference does not include worlds in which only one method has a value: only “fixed” in 13 "
                "worlds, only “adaptive” in 1 world."));
}

TEST(Answer, AdmitsThatNothingCouldBeCompared) {
  EXPECT_THAT(AnswerTo(Figures(0, std::nullopt, std::nullopt, std::nullopt, 0, Verdict::kUndecided)),
              HasSubstr("no world has values of both methods"));
}

TEST(Answer, SaysThatItDependsWhenConditionsDisagree) {
  ScenarioSummary scenario = OneComparison(Figures(9, -2.0, -3.0, -1.0, 1, Verdict::kBetter));
  scenario.conditions.push_back(scenario.conditions.front());
  scenario.conditions[0].condition = {{"noise", "5"}};
  scenario.conditions[1].condition = {{"noise", "20"}};
  scenario.conditions[1].comparisons[0].verdict = Verdict::kWorse;
  scenario.conditions[1].comparisons[0].difference = 4.0;
  const MethodFinding answer = FindingsOf(RunData{}, scenario).answer;
  EXPECT_FALSE(answer.verdict.has_value());
  EXPECT_EQ(answer.Words(), "differs by condition on these worlds");
  EXPECT_THAT(answer.sentence, HasSubstr("better under 1 of 2, worse under 1 of 2"));
  EXPECT_THAT(answer.sentence, HasSubstr(": −2.00° (95 % CI −3.00 to −1.00; noise=5) to 4.00° (−3.00 to "
                                         "−1.00; noise=20), on 9 worlds each."));
}

TEST(Answer, OfASingleMethodComparesNothing) {
  const auto scenario = OneComparison({}, {"fixed"});
  EXPECT_THAT(FindingsOf(RunData{}, scenario).answer.sentence, HasSubstr("only one method ran"));
}

TEST(Findings, KeepEveryFailureWithItsReason) {
  const RunData run = ExampleRun();
  const ScenarioFindings findings = FindingsOf(run, run.scenarios[0]);
  int ok = 0, others = 0;
  for (const auto& [status, count] : findings.statuses) (status == Status::kOk ? ok : others) += count;
  EXPECT_EQ(ok + others, findings.cells);
  EXPECT_EQ(others, 4);
  int explained = 0;
  for (const ReasonCount& reason : findings.reasons) explained += reason.cells;
  EXPECT_EQ(explained, others);
}

TEST(Findings, GroupReasonsThatDifferInNumbersOrFilesAlone) {
  RunData run = ExampleRun();
  const ScenarioFindings before = FindingsOf(run, run.scenarios[0]);
  Row row = run.rows.front();
  row.scenario = run.scenarios[0].name;
  row.result = CellResult::Ended(Status::kUnsolved, "");
  for (const char* reason : {"3 of 4 effectors missed by 1.25 cm", "2 of 4 effectors missed by 0.5 cm", "never began",
                             "t/a.bvh:1:1: no motion", "t/b-2.bvh:7:12: no motion"}) {
    row.result.reason = reason;
    run.rows.push_back(row);
  }
  const ScenarioFindings findings = FindingsOf(run, run.scenarios[0]);
  EXPECT_EQ(findings.reasons.size(), before.reasons.size() + 3);
  const auto count_of = [&](const std::string& words) {
    const auto found =
        std::ranges::find_if(findings.reasons, [&](const ReasonCount& one) { return one.Words() == words; });
    return found == findings.reasons.end() ? 0 : found->cells;
  };
  EXPECT_EQ(count_of("for example: 3 of 4 effectors missed by 1.25 cm"), 2);
  EXPECT_EQ(count_of("never began"), 1);
  EXPECT_EQ(count_of("for example: t/a.bvh:1:1: no motion"), 2);
}

TEST(Findings, TellTheDoubtsAboutCellsBesideTheirReasons) {
  RunData run = ExampleRun();
  const auto ok = std::ranges::find_if(run.rows, [&](const Row& row) {
    return row.scenario == run.scenarios[0].name && row.result.status == Status::kOk;
  });
  ASSERT_NE(ok, run.rows.end());
  EXPECT_TRUE(FindingsOf(run, run.scenarios[0]).doubts.empty());
  ok->result.reason += DoubtfulPart("the answer: ", {"freezes for 2 s", "lies along Z"});
  const ScenarioFindings findings = FindingsOf(run, run.scenarios[0]);
  EXPECT_EQ(findings.doubtful, 1);
  ASSERT_EQ(findings.doubts.size(), 2u);
  EXPECT_EQ(DescribeCount(findings.doubts[0]), "1 × doubtful in " + ok->method + ": the answer: freezes for 2 s");
  EXPECT_THAT(StatusSentence(findings), HasSubstr("; doubtful: 1"));
  EXPECT_THAT(StatusSentence(FindingsOf(ExampleRun(), run.scenarios[0])), Not(HasSubstr("doubtful")));
  // A doubt is no part of the reason of a cell that failed.
  const auto failed = std::ranges::find_if(run.rows, [&](const Row& row) {
    return row.scenario == run.scenarios[0].name && row.result.status == Status::kFailed;
  });
  ASSERT_NE(failed, run.rows.end());
  failed->result.reason += DoubtfulPart("the answer: ", {"freezes for 2 s"});
  const ScenarioFindings both = FindingsOf(run, run.scenarios[0]);
  EXPECT_EQ(both.doubtful, 2);
  ASSERT_EQ(both.reasons.size(), findings.reasons.size());
  for (std::size_t i = 0; i < both.reasons.size(); ++i) EXPECT_EQ(both.reasons[i].Words(), findings.reasons[i].Words());
}

TEST(Findings, CountTheCellsOfAMethodWithoutAnAnswer) {
  RunData run;
  for (const char* name : {"b", "a"}) run.scenarios.push_back({.name = name});
  const auto add = [&](const char* scenario, const char* method, Status status, const char* reason) {
    Row row;
    row.scenario = scenario;
    row.method = method;
    row.result = CellResult::Ended(status, reason);
    run.rows.push_back(row);
  };
  EXPECT_TRUE(FailuresOf(run).empty());
  add("a", "x", Status::kOk, "");
  add("a", "x", Status::kCrashed, "signal 11");
  add("a", "x", Status::kUnsolved, "3 missed");
  add("a", "x", Status::kUnsolved, "gave no answer: shy");
  add("a", "x", Status::kSkipped, "no foot");
  add("a", "x", Status::kCrashed, "signal 6");
  add("b", "x", Status::kFailed, "never began");
  std::vector<std::string> lines;
  for (const FailureCount& one : FailuresOf(run)) lines.push_back(DescribeFailure(one));
  EXPECT_EQ(lines, (std::vector<std::string>{"failed: 1 of 1 cell of x in b: never began",
                                             "crashed: 2 of 5 cells of x in a: for example: signal 11",
                                             "unsolved: 1 of 5 cells of x in a: gave no answer: shy"}));
}

TEST(Findings, OfTheRunCountExpectationsAndCells) {
  const RunFindings findings = FindingsOf(ExampleRun());
  EXPECT_EQ(findings.met, 3);
  EXPECT_EQ(findings.unmet, 1);
  EXPECT_EQ(findings.undecided, 1);
  EXPECT_LT(findings.ok, findings.cells);
  EXPECT_THAT(findings.sentence, HasSubstr("3 of 5 expectations were met, 1 was not met, 1 is undecided."));
}

TEST(Findings, SayWhyAValueIsMissing) {
  const RunData run = ExampleRun();
  EXPECT_THAT(MissingReasons(run, "transition", {}, "fuzzy-bridge", "jump_cm"), HasSubstr("2 × no bridge frame"));
  EXPECT_EQ(MissingReasons(run, "transition", {}, "now", "jump_cm"), "");
}

TEST(Findings, NeverCallWhatWasMeasuredReached) {
  RunData run = ExampleRun();
  EXPECT_THAT(FindingsOf(run).sentence, Not(HasSubstr("reached")));
  EXPECT_THAT(FindingsOf(run).sentence, HasSubstr("cells were measured, 6 could not be measured."));
  for (Row& row : run.rows) row.result.status = Status::kOk;
  EXPECT_THAT(FindingsOf(run).sentence, HasSubstr(" cells were measured."));
  RunData one;
  one.rows = {run.rows.front()};
  EXPECT_EQ(FindingsOf(one).sentence, "The only cell was measured.");
  run.rows.front().result.status = Status::kUnsolved;
  EXPECT_THAT(FindingsOf(run).sentence,
              HasSubstr(" cells were measured, 1 of them unsolved (the answer missed the goal)."));
  // A cell whose program answered `no_answer` was not measured.
  one.rows.front().result = CellResult::Ended(Status::kUnsolved, "gave no answer: 'no'");
  EXPECT_EQ(FindingsOf(one).sentence, "The only cell was not measured, 1 without an answer.");
  const ScenarioFindings unanswered = FindingsOf(one, ScenarioSummary{.name = one.rows.front().scenario});
  EXPECT_EQ(unanswered.reasons.size(), 1u);
}

TEST(Findings, GiveSuccessItsOwnShareWhateverTheStatus) {
  RunData run = ExampleRun();
  const ScenarioSummary& scenario = run.scenarios.front();
  EXPECT_TRUE(FindingsOf(run, scenario).successes.empty());
  int trial = 0;
  for (Row& row : run.rows) {
    if (row.scenario != scenario.name) continue;
    row.result.status = Status::kOk;
    row.result.Measure("natural_share", row.method == "gate-inertialised" && trial++ % 4 != 0 ? 1 : 0);
  }
  const auto successes = FindingsOf(run, scenario).successes;
  ASSERT_EQ(successes.size(), 1u);
  EXPECT_EQ(SuccessSentence(successes.front()),
            "Reached (share “as smooth as unbroken motion”): now 0 %, wait-for-end 0 %, fuzzy-bridge 0 %, "
            "fuzzy-bridge-adaptive 0 %, gate-inertialised 75.0 %.");
}

TEST(Findings, OfManyMethodsNameTheLeastAndTheMostSuccessful) {
  SuccessFinding finding{"natural_share", {}};
  for (int i = 0; i < 40; ++i) finding.shares.emplace_back("method-" + std::to_string(i), i / 40.0);
  EXPECT_EQ(SuccessSentence(finding),
            "Reached (share “as smooth as unbroken motion”): from method-0 0 % to method-39 97.5 %, of 40 methods.");
}

TEST(Findings, GiveAFewFiguresOfTheMethodItsBaselineAndTheStrongestOther) {
  RunData run = UnitRun();
  for (const Row& row : run.rows) run.cpu_seconds[row.Id()] = row.method == "gate-inertialised" ? 2 : 0.25;
  const KeyFigures figures = FindingsOf(run, run.scenarios[0]).figures;
  ASSERT_EQ(figures.methods.size(), 3u);
  EXPECT_EQ(figures.methods[0].name, "wait-for-end");
  EXPECT_EQ(figures.methods[1].name, "now");
  EXPECT_EQ(figures.methods[2].name, "gate-inertialised");
  EXPECT_EQ(figures.labels, (std::vector<std::string>{"jump at the transition point", "cells with status ok",
                                                      "processor time", "worlds in which “wait-for-end” is better"}));
  EXPECT_EQ(figures.methods[2].values[0], "6.40 cm");
  EXPECT_EQ(figures.methods[1].values[2], "250 ms");
  EXPECT_EQ(figures.methods[2].values[2], "2.00 s");
  EXPECT_EQ(figures.methods[0].values[3], "");
  // Cold caches are a large part of a short time.
  for (auto& [id, seconds] : run.cpu_seconds) seconds *= 0.001;
  const KeyFigures brief = FindingsOf(run, run.scenarios[0]).figures;
  EXPECT_EQ(brief.methods[1].values[2], "0.250 ms (too short to judge)");
  EXPECT_EQ(brief.methods[2].values[2], "2.00 ms");
  // Nothing is said about times that were not measured, nor without a comparison.
  EXPECT_EQ(FindingsOf(UnitRun(), run.scenarios[0]).figures.labels.size(), 3u);
  EXPECT_TRUE(FindingsOf(RunData{}, OneComparison({}, {"fixed"})).figures.methods.empty());
}

TEST(Findings, AnswerTwiceAndSayWhatTheVerdictIsAbout) {
  const RunData run = UnitRun();
  const ScenarioFindings capture = FindingsOf(run, run.scenarios[3]);
  EXPECT_THAT(capture.headline, HasSubstr(" on these clips ("));
  EXPECT_THAT(capture.answer.sentence, HasSubstr(" worlds of 4 clips."));
  EXPECT_THAT(capture.answer.BothVerdicts(), ::testing::EndsWith(" on these clips, no verdict for other clips"));
  const ScenarioFindings transition = FindingsOf(run, run.scenarios[0]);
  EXPECT_EQ(transition.answer.baseline, "now");
  EXPECT_EQ(transition.rival.baseline, "gate-inertialised");
  EXPECT_THAT(transition.headline, HasSubstr("; has 7.83 × the jump at the transition point of “gate-inertialised”"));
  EXPECT_THAT(FindingsOf(run, run.scenarios[2]).answer.BothVerdicts(), ::testing::EndsWith(" for other worlds"));
}

}  // namespace
}  // namespace etude
