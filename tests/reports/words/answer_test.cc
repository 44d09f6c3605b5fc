#include "reports/words/answer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Comparison Compared(const std::string& metric, const std::string& baseline, Verdict verdict) {
  Comparison c;
  c.metric = metric;
  c.method = "adaptive";
  c.baseline = baseline;
  c.pairs = c.differing = 20;
  c.difference = c.mean = verdict == Verdict::kBetter ? -1 : 1;
  c.verdict = verdict;
  c.beyond.verdict = verdict;
  c.beyond.units = 20;
  return c;
}

MethodSummary Method(const std::string& name, double error_deg, double iterations) {
  MethodSummary method{.method = name};
  for (const auto& [id, value] : {std::pair("orientation_error_deg", error_deg), std::pair("iterations", iterations)}) {
    MetricSummary& summary = method.metrics.emplace_back();
    summary.id = id;
    summary.median = summary.mean = value;
  }
  return method;
}

/// `adaptive` is better than its baseline `fixed`. It is as exact as gauss-newton, but takes 560 iterations instead
/// of 4.
ScenarioSummary SolverSummary() {
  ScenarioSummary scenario{.methods = {"fixed", "adaptive", "gauss-newton"}};
  scenario.headline_metrics = {"orientation_error_deg", "iterations"};
  ConditionSummary condition;
  condition.methods = {Method("fixed", 8.8, 600), Method("adaptive", 0.06, 560), Method("gauss-newton", 0.05, 4)};
  condition.comparisons = {Compared("orientation_error_deg", "fixed", Verdict::kBetter),
                           Compared("iterations", "fixed", Verdict::kNoDifference)};
  condition.rivals = {Compared("orientation_error_deg", "gauss-newton", Verdict::kNoDifference),
                      Compared("iterations", "gauss-newton", Verdict::kWorse)};
  scenario.conditions = {condition};
  return scenario;
}

std::string HeadlineOfSolvers(const ScenarioSummary& scenario) {
  return HeadlineOf(scenario, "adaptive", "orientation_error_deg");
}

TEST(Headline, AnswersAgainstTheBaselineAndAgainstTheBestOther) {
  EXPECT_EQ(HeadlineOfSolvers(SolverSummary()),
            "“adaptive”: better than “fixed” (effector orientation error −1.00°); no different from “gauss-newton” "
            "(+1.00°), but needs 140 × the solver steps");
}

/// Adds answers to SolverSummary. Against gauss-newton, success decides: its share is 58 percentage points lower.
ScenarioSummary AnsweredSummary() {
  ScenarioSummary scenario = SolverSummary();
  ConditionSummary& condition = scenario.conditions[0];
  Answer of_baseline{.method = "adaptive", .baseline = "fixed", .value_metric = "orientation_error_deg"};
  of_baseline.verdict = Verdict::kBetter;
  of_baseline.beyond = Verdict::kBetter;
  of_baseline.decided_by = AnswerStep::kValue;
  Answer of_rival = of_baseline;
  of_rival.baseline = "gauss-newton";
  of_rival.verdict = Verdict::kWorse;
  of_rival.beyond = Verdict::kWorse;
  of_rival.decided_by = AnswerStep::kSuccess;
  of_rival.success = Compared("solved_practical", "gauss-newton", Verdict::kWorse);
  of_rival.success->difference = -0.58;
  of_rival.success->ci_low = -0.70;
  of_rival.success->ci_high = -0.44;
  of_rival.success->worse = 12;
  of_rival.both_succeed = Compared("orientation_error_deg", "gauss-newton", Verdict::kUndecided);
  of_rival.both_succeed->pairs = 8;
  condition.answers = {of_baseline};
  condition.rival_answers = {of_rival};
  return scenario;
}

TEST(Headline, IsAboutSuccessWhereThatDecides) {
  EXPECT_EQ(HeadlineOfSolvers(AnsweredSummary()),
            "“adaptive”: better than “fixed” (effector orientation error −1.00°); worse than “gauss-newton” (share "
            "“solved (0.1 cm, 0.1°)” −58.0 pp) and needs 140 × the solver steps");
  const MethodFinding found = CompareInWords(AnsweredSummary(), "adaptive", "orientation_error_deg", Against::kRival);
  EXPECT_EQ(found.verdict, Verdict::kWorse);
  EXPECT_THAT(found.sentence, HasSubstr("the difference matters in 12 of 20 worlds"));
  EXPECT_THAT(found.sentence, HasSubstr("Difference in effector orientation error: 1.00° on 20 worlds."));
  EXPECT_THAT(found.sentence, HasSubstr("Where both succeed (8 worlds): effector orientation error 1.00°."));
  // The control: for a metric other than the question's, the comparison's own verdict counts.
  EXPECT_EQ(CompareInWords(AnsweredSummary(), "adaptive", "iterations", Against::kBaseline).verdict,
            Verdict::kNoDifference);
}

TEST(Headline, TellsOfATailThatDecides) {
  ScenarioSummary scenario = AnsweredSummary();
  Answer& answer = scenario.conditions[0].answers[0];
  Comparison& value = scenario.conditions[0].comparisons[0];
  value.verdict = Verdict::kUndecided;
  value.difference = value.ci_low = value.ci_high = 0;
  value.mean = 6.3, value.mean_low = 3.19, value.mean_high = 9.61;
  answer.verdict = Verdict::kWorse;
  answer.decided_by = AnswerStep::kTail;
  answer.tail = Compared("orientation_error_deg", "fixed", Verdict::kWorse);
  answer.tail->better = 1;
  answer.tail->worse = 7;
  const MethodFinding found = CompareInWords(scenario, "adaptive", "orientation_error_deg", Against::kBaseline);
  EXPECT_EQ(found.verdict, Verdict::kWorse);
  EXPECT_EQ(found.sentence,
            "“adaptive” is worse than “fixed”: far worse in 7 of 20 worlds, far better in 1; effector orientation "
            "error, median 0° (95 % CI 0–0), mean 6.30° (3.19–9.61) on 20 worlds.");
  EXPECT_THAT(HeadlineOfSolvers(scenario),
              HasSubstr("(effector orientation error far worse in 7 of 20 worlds, far better in 1)"));
  const ConditionSummary& condition = scenario.conditions[0];
  EXPECT_EQ(AsAnswered(condition, value).verdict, Verdict::kWorse);
  EXPECT_EQ(AsAnswered(condition, value).why_open, "the tail decides: far worse in 7 of 20 worlds, far better in 1");
  // The control: another metric, and an answer that the tail did not decide, keep the comparison's verdict.
  EXPECT_EQ(AsAnswered(condition, condition.comparisons[1]).verdict, Verdict::kNoDifference);
  answer.decided_by = AnswerStep::kNone;
  EXPECT_EQ(AsAnswered(condition, value).verdict, Verdict::kUndecided);
}

TEST(Answer, OfWorldsWithoutTheValueIsAboutSuccessWithItsReason) {
  ScenarioSummary scenario = AnsweredSummary();
  scenario.unit = SamplingUnit::kPerson;
  ConditionSummary& condition = scenario.conditions[0];
  Answer& answer = condition.answers[0];
  answer.verdict = Verdict::kUndecided;
  answer.beyond = Verdict::kUndecided;
  answer.decided_by = AnswerStep::kNone;
  answer.success = Compared("f1", "fixed", Verdict::kUndecided);
  answer.success->difference = answer.success->mean = -0.706, answer.success->ci_low = -0.835,
  answer.success->ci_high = -0.616;
  answer.success->why_open = "too few people";
  condition.comparisons[0].pairs = 0;
  condition.comparisons[0].only_baseline = 6;
  const auto sentence = [&] {
    return CompareInWords(scenario, "adaptive", "orientation_error_deg", Against::kBaseline).sentence;
  };
  EXPECT_EQ(sentence(),
            "It is undecided whether “adaptive” changes the mean F1 against “fixed”: −70.6 pp (95 % CI "
            "−83.5 to −61.6) on 20 worlds. Why: too few people.");
  EXPECT_THAT(HeadlineOfSolvers(scenario), HasSubstr("undecided against “fixed” (mean F1 −70.6 pp)"));
  // The control: with values, the sentence is about the value, and success follows.
  condition.comparisons[0] = Compared("orientation_error_deg", "fixed", Verdict::kUndecided);
  EXPECT_THAT(sentence(), HasSubstr("the effector orientation error"));
  EXPECT_THAT(sentence(),
              HasSubstr("It is undecided whether success differs: mean F1 −70.6 pp (−83.5 to −61.6); too few"));
}

TEST(Answer, ThatIsOpenSaysSoBeforeAValueThatIsNot) {
  ScenarioSummary scenario = AnsweredSummary();
  Comparison& value = scenario.conditions[0].comparisons[0];
  value.ci_low = -2, value.ci_high = -0.5;
  const auto sentence = [&] {
    return CompareInWords(scenario, "adaptive", "orientation_error_deg", Against::kBaseline).sentence;
  };
  EXPECT_THAT(sentence(), ::testing::StartsWith("“adaptive” lowers the effector orientation error by 1.00°"));
  scenario.conditions[0].answers[0].verdict = Verdict::kUndecided;
  scenario.conditions[0].answers[0].decided_by = AnswerStep::kNone;
  EXPECT_THAT(sentence(),
              ::testing::StartsWith("Undecided: “adaptive” lowers the effector orientation error by 1.00°"));
}

TEST(Answer, ShowsOneIntervalOfOneDifference) {
  ScenarioSummary scenario = AnsweredSummary();
  scenario.headline_metrics = {"orientation_error_deg", "solved_practical"};
  ConditionSummary& condition = scenario.conditions[0];
  Comparison& of_table = condition.rivals.emplace_back(*condition.rival_answers[0].success);
  of_table.ci_low = -0.71;
  const auto shown = [&] { return AnswersOf(scenario, "adaptive", Against::kRival).front().comparison->ci_low; };
  EXPECT_EQ(shown(), -0.71);
  of_table.pairs = 19;  // the control: the table compares fewer worlds than the answer
  EXPECT_EQ(shown(), -0.70);
}

TEST(Headline, ThatSuccessAndValueDecideUnderDifferentConditionsHasNoFigure) {
  ScenarioSummary scenario = AnsweredSummary();
  scenario.conditions.push_back(scenario.conditions.front());
  scenario.conditions[1].rival_answers[0].decided_by = AnswerStep::kValue;
  scenario.conditions[1].rival_answers[0].verdict = Verdict::kBetter;
  EXPECT_THAT(HeadlineOfSolvers(scenario), HasSubstr("compared with “gauss-newton”, the verdict depends on the "
                                                     "condition: better under 1 of 2, worse under 1 of 2"));
}

TEST(Headline, NamesTheRatioWhereTheRivalIsBetterByTheQuestionsMetric) {
  ScenarioSummary scenario = SolverSummary();
  scenario.conditions[0].rivals = {Compared("iterations", "gauss-newton", Verdict::kWorse)};
  scenario.headline_metrics = {"iterations"};
  EXPECT_EQ(
      HeadlineOf(scenario, "adaptive", "iterations"),
      "“adaptive”: no different from “fixed” (solver steps +1.00); needs 140 × the solver steps of “gauss-newton”");
}

TEST(Headline, GivesTheRangeOfRatiosOverConditions) {
  ScenarioSummary scenario = SolverSummary();
  scenario.conditions.push_back(scenario.conditions.front());
  scenario.conditions[1].methods[2] = Method("gauss-newton", 0.05, 8);
  EXPECT_THAT(HeadlineOfSolvers(scenario), HasSubstr("needs 70.0–140 × the solver steps"));
}

TEST(Headline, GivesTheLeastAndTheLargestDifferenceOverConditions) {
  ScenarioSummary scenario = SolverSummary();
  scenario.conditions.push_back(scenario.conditions.front());
  scenario.conditions[1].comparisons[0].difference = -7.85;
  EXPECT_THAT(HeadlineOfSolvers(scenario), HasSubstr("than “fixed” (effector orientation error −7.85 to −1.00°);"));
  // The sentence also gives the smallest and the largest difference if their signs differ.
  scenario.conditions.push_back(scenario.conditions.front());
  scenario.conditions[2].comparisons[0].difference = 0.5;
  EXPECT_THAT(CompareInWords(scenario, "adaptive", "orientation_error_deg", Against::kBaseline).sentence,
              HasSubstr(": −7.85° () to 0.500° (), on 20 worlds each"));
  for (ConditionSummary& condition : scenario.conditions) condition.comparisons[0].difference.reset();
  EXPECT_THAT(HeadlineOfSolvers(scenario), HasSubstr("better than “fixed”;"));
}

TEST(Headline, SaysThatNothingIsDecided) {
  ScenarioSummary scenario = SolverSummary();
  scenario.conditions[0].rivals = {Compared("orientation_error_deg", "gauss-newton", Verdict::kUndecided)};
  const std::string headline = HeadlineOfSolvers(scenario);
  EXPECT_THAT(headline, HasSubstr("; undecided against “gauss-newton”"));
  EXPECT_THAT(headline, Not(HasSubstr("no different")));
}

TEST(Headline, SaysWhereItIsAboutTheseClipsOnly) {
  ScenarioSummary scenario = SolverSummary();
  scenario.unit = SamplingUnit::kClip;
  EXPECT_THAT(HeadlineOfSolvers(scenario), Not(HasSubstr("on these clips")));
  scenario.conditions[0].comparisons[0].beyond.verdict = std::nullopt;
  EXPECT_THAT(HeadlineOfSolvers(scenario), HasSubstr("better than “fixed” on these clips (effector"));
  scenario.conditions[0].comparisons[0].beyond.why_open = "4 clips: no verdict for others";
  const auto sentence = [&] {
    return CompareInWords(scenario, "adaptive", "orientation_error_deg", Against::kBaseline).sentence;
  };
  EXPECT_THAT(sentence(), HasSubstr(" For other clips: 4 clips: no verdict for others."));
  scenario.unit = SamplingUnit::kRecordedPerson;
  EXPECT_THAT(sentence(), HasSubstr(" of 20 people. For other people: 4 clips"));
  scenario.unit = SamplingUnit::kWorld;
  EXPECT_THAT(sentence(), Not(HasSubstr("For other")));
  scenario.unit = SamplingUnit::kClip;
  // A verdict against the strongest other method also says “on these clips” if it is undecided for other clips.
  EXPECT_THAT(HeadlineOfSolvers(scenario), HasSubstr("no different from “gauss-newton” (+1.00°)"));
  scenario.conditions[0].rivals[0].beyond.verdict = Verdict::kUndecided;
  EXPECT_THAT(HeadlineOfSolvers(scenario), HasSubstr("no different from “gauss-newton” on these clips (+1.00°)"));
}

TEST(Headline, NamesBothRivalsWhereHalvesOfTheWorldsChoseDifferently) {
  ScenarioSummary scenario = SolverSummary();
  scenario.headline_metrics = {"iterations"};
  scenario.conditions[0].methods[0] = Method("fixed", 8.8, 8);
  scenario.conditions[0].rivals = {Compared("iterations", "fixed or gauss-newton", Verdict::kWorse)};
  EXPECT_THAT(HeadlineOf(scenario, "adaptive", "iterations"),
              HasSubstr("needs 70.0–140 × the solver steps of “fixed” or “gauss-newton”"));
  // A method's name may contain "or".
  scenario.conditions[0].methods[2].method = "fixed or gauss-newton";
  EXPECT_THAT(HeadlineOf(scenario, "adaptive", "iterations"), HasSubstr("needs 140 × the solver steps of “fixed or "));
}

TEST(Headline, SaysBetterTwiceInOneBreath) {
  ScenarioSummary scenario = SolverSummary();
  scenario.conditions[0].rivals = {Compared("orientation_error_deg", "gauss-newton", Verdict::kBetter)};
  EXPECT_EQ(HeadlineOfSolvers(scenario),
            "“adaptive”: better than “fixed” (effector orientation error −1.00°); also better than the strongest other "
            "method, "
            "“gauss-newton” (−1.00°)");
}

TEST(Headline, NamesABaselineThatIsTheBestOtherOnce) {
  ScenarioSummary scenario = SolverSummary();
  scenario.conditions[0].rivals = {Compared("orientation_error_deg", "fixed", Verdict::kBetter)};
  EXPECT_EQ(HeadlineOfSolvers(scenario),
            "“adaptive”: better than “fixed” (effector orientation error −1.00°), the strongest other method");
}

TEST(Headline, OfARunWithoutRivalsAnswersOnce) {
  ScenarioSummary scenario = SolverSummary();
  scenario.conditions[0].rivals.clear();
  EXPECT_EQ(HeadlineOfSolvers(scenario), "“adaptive”: better than “fixed” (effector orientation error −1.00°)");
  scenario.conditions[0].comparisons.clear();
  EXPECT_EQ(HeadlineOfSolvers(scenario), "");
}

TEST(CostRatio, IsOfCostsThatAreAtLeastTwiceAsLargeAndNotOfNothing) {
  ScenarioSummary scenario = SolverSummary();
  const auto ratio = [&] {
    const auto found = CostRatioOf(JudgedOf(scenario, "adaptive", "iterations", Against::kRival));
    return found ? found->least : 0;
  };
  EXPECT_DOUBLE_EQ(ratio(), 140);
  auto& theirs = scenario.conditions[0].methods[2].metrics[1].median;
  theirs = 280.0;
  EXPECT_DOUBLE_EQ(ratio(), 2);
  theirs = 281.0;
  EXPECT_DOUBLE_EQ(ratio(), 0);
  theirs = 1e-9;  // practically zero, so a ratio would compare rounding errors
  EXPECT_DOUBLE_EQ(ratio(), 0);
}

TEST(CostRatio, IsNeverOfAShare) {
  ScenarioSummary scenario = SolverSummary();
  for (auto& method : scenario.conditions[0].methods) method.metrics[1].id = "false_smooth";
  scenario.conditions[0].rivals[1].metric = "false_smooth";
  EXPECT_FALSE(CostRatioOf(JudgedOf(scenario, "adaptive", "false_smooth", Against::kRival)).has_value());
}

}  // namespace
}  // namespace etude
