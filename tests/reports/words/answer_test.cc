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

/// 560 iterations: better than its baseline, and as exact as gauss-newton, which takes 4.
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

/// Adds answers to the solvers; against gauss-newton, success decides: 58 points worse.
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
  EXPECT_THAT(found.sentence, HasSubstr("Where both succeed (8 worlds): effector orientation error 1.00°."));
  // The control: for a metric other than the question's, the comparison's own verdict counts.
  EXPECT_EQ(CompareInWords(AnsweredSummary(), "adaptive", "iterations", Against::kBaseline).verdict,
            Verdict::kNoDifference);
}

TEST(Headline, TellsOfATailThatDecides) {
  ScenarioSummary scenario = AnsweredSummary();
  Answer& answer = scenario.conditions[0].answers[0];
  scenario.conditions[0].comparisons[0].verdict = Verdict::kNoDifference;
  answer.verdict = Verdict::kWorse;
  answer.decided_by = AnswerStep::kTail;
  answer.tail = Compared("orientation_error_deg", "fixed", Verdict::kWorse);
  answer.tail->better = 1;
  answer.tail->worse = 7;
  const MethodFinding found = CompareInWords(scenario, "adaptive", "orientation_error_deg", Against::kBaseline);
  EXPECT_EQ(found.verdict, Verdict::kWorse);
  EXPECT_THAT(found.sentence, HasSubstr("The tail decides: far better in 1, far worse in 7 of 20 worlds."));
}

TEST(Headline, ThatSuccessAndValueDecideUnderDifferentConditionsHasNoFigure) {
  ScenarioSummary scenario = AnsweredSummary();
  scenario.conditions.push_back(scenario.conditions.front());
  scenario.conditions[1].rival_answers[0].decided_by = AnswerStep::kValue;
  scenario.conditions[1].rival_answers[0].verdict = Verdict::kBetter;
  EXPECT_THAT(HeadlineOfSolvers(scenario),
              HasSubstr("against “gauss-newton” it depends: better under 1 of 2, worse under 1 of 2"));
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
  EXPECT_THAT(HeadlineOfSolvers(scenario), ::testing::EndsWith(", on these clips"));
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
