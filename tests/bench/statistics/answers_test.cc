#include "bench/statistics/answers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>

#include "bench/statistics/summary.h"

namespace etude {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The values of one cell: 1 if it solved its world, and its position error; NaN (kNone) if the cell crashed.
struct CellValues {
  double solved = 1, error_cm = 1;
};

/// Returns the values of methods a (the baseline), b and c in one world.
using WorldOf = std::function<std::array<CellValues, 3>(int trial)>;

Study IkStudy(int trials) {
  Study study{.scenario = "s", .task = "ik", .trials = trials, .methods = {{"a", "a"}, {"b", "a"}, {"c", "a"}}};
  study.conditions = {{}};
  study.metrics = {"position_error_cm"};
  study.success = "solved_practical";
  return study;
}

ScenarioSummary SummaryOf(const Study& study, const WorldOf& world) {
  ScenarioTable table(study);
  for (int trial = 0; trial < study.trials; ++trial) {
    std::vector<CellValues> cells;
    std::ranges::copy(world(trial), std::back_inserter(cells));
    cells.resize(study.methods.size(), cells.back());  // further methods do what c does
    for (std::size_t m = 0; m < study.methods.size(); ++m) {
      Row row{"s", "ik", {}, trial, "", {}, study.methods[m].name, {}};
      if (std::isnan(cells[m].error_cm)) {
        row.result = CellResult::Ended(Status::kCrashed, "its worker ended");
        row.result.Missing("position_error_cm", "crashed");
      } else {
        row.result.status = cells[m].solved == 1 ? Status::kOk : Status::kUnsolved;
        row.result.Measure("position_error_cm", cells[m].error_cm);
        row.result.Measure("solved_practical", cells[m].solved);
      }
      table.Add(row);
    }
  }
  return Summarise(study, table, 1);
}

Answer AnswerOf(const Study& study, const WorldOf& world) {
  return SummaryOf(study, world).conditions.front().answers.front();
}

TEST(McNemarMidP, AgreesWithFagerlandLydersenAndLaake) {
  // Fagerland, Lydersen & Laake (2013), table 1: 1 and 7 discordant pairs, mid-p 0.039.
  EXPECT_NEAR(McNemarMidP(7, 1), 0.0390625, 1e-9);
  EXPECT_NEAR(McNemarMidP(1, 7), 0.0390625, 1e-9);
  EXPECT_EQ(McNemarMidP(0, 0), 1);
  EXPECT_EQ(McNemarMidP(4, 4), 1);
  EXPECT_DOUBLE_EQ(McNemarMidP(5, 0), 1.0 / 32);
}

TEST(WorldsNeeded, IsWhereTheLargestDifferenceIsDecided) {
  // b is better than a in every world, by a different amount in each, and c equals a. So only the number of worlds can
  // leave the verdict on b open.
  const auto verdict_on = [](Study study, double a_solves) {
    return AnswerOf(study, [&](int trial) -> std::array<CellValues, 3> {
      return {{{a_solves, 9.0 + trial}, {1, 1}, {a_solves, 9.0 + trial}}};
    });
  };
  const auto least = [&](Study study, double a_solves) {
    for (study.trials = 2; verdict_on(study, a_solves).verdict != Verdict::kBetter;) ++study.trials;
    return study.trials;
  };
  EXPECT_EQ(WorldsNeeded(IkStudy(4)), 6);
  EXPECT_EQ(least(IkStudy(4), 0), 6) << "by success; McNemar's mid-p is 1 / 64";
  Study graded = IkStudy(4);  // success is a score; with two comparisons, p = 2 / 2ⁿ must be at most 0.025
  graded.task = "detection";
  graded.success = "f1";
  graded.metrics = {"f1", "precision"};
  EXPECT_EQ(WorldsNeeded(graded), 7);
  Study many = IkStudy(4);
  for (const char* more : {"d", "e", "f", "g"}) many.methods.push_back({more, "a"});
  EXPECT_EQ(WorldsNeeded(many), 7) << "six answers: 1 / 2⁷ ≤ 0.05 / 6";
  EXPECT_EQ(least(many, 0), 7);
}

TEST(Answer, SaysWhyAStepIsUndecided) {
  Study study = IkStudy(6);
  for (const char* more : {"d", "e", "f", "g"}) study.methods.push_back({more, "a"});
  const auto answer = [&] {
    return AnswerOf(study, [](int) -> std::array<CellValues, 3> { return {{{0, 9}, {1, 1}, {0, 9}}}; });
  };
  EXPECT_EQ(answer().success->why_open,
            "too few worlds: 6 of 6 pairs differ, so p ≥ 0.016; one of 6 comparisons (Holm) needs at least 7");
  study.unit = SamplingUnit::kPerson;
  EXPECT_TRUE(answer().success->why_open.starts_with("too few people: ")) << answer().success->why_open;
  study.trials = 7;
  EXPECT_EQ(answer().success->why_open, "") << "the control: 7 are enough";
}

TEST(Answer, IsAboutSuccessBeforeAnyValue) {
  // b has the smaller error where it succeeds, but solves 42 % of the worlds; a solves all.
  const Answer answer = AnswerOf(IkStudy(60), [](int trial) -> std::array<CellValues, 3> {
    const bool solved = trial % 12 < 5;
    return {{{1, 3.0 + 0.01 * trial}, {solved ? 1.0 : 0.0, 1}, {1, 3}}};
  });
  EXPECT_EQ(answer.verdict, Verdict::kWorse);
  EXPECT_EQ(answer.decided_by, AnswerStep::kSuccess);
  EXPECT_EQ(answer.success->metric, "solved_practical");
  EXPECT_NEAR(*answer.success->difference, -35.0 / 60, 1e-12);
  EXPECT_EQ(answer.success->sign_flip.how, "McNemar's mid-p");
  ASSERT_TRUE(answer.both_succeed);
  EXPECT_EQ(answer.both_succeed->pairs, 25);
  EXPECT_EQ(answer.both_succeed->verdict, Verdict::kBetter);
}

TEST(Expectation, AboutTheValueIsUnmetWhereSuccessIsWorse) {
  const auto expectation_when = [](int solved_of_12) {
    Study study = IkStudy(60);
    Expectation& below = study.expectations.emplace_back();
    below.metric = "position_error_cm";
    below.of = "b";
    below.below = "a";
    return SummaryOf(study,
                     [&](int trial) -> std::array<CellValues, 3> {
                       return {{{1, 3.0 + 0.01 * trial}, {trial % 12 < solved_of_12 ? 1.0 : 0.0, 1}, {1, 3}}};
                     })
        .expectations.front();
  };
  EXPECT_EQ(expectation_when(12).outcome, ClaimOutcome::kMet);
  const ExpectationResult judged = expectation_when(5);
  EXPECT_EQ(judged.outcome, ClaimOutcome::kUnmet);
  EXPECT_NE(judged.detail.find(" cm (95 % interval"), std::string::npos) << judged.detail;
  EXPECT_NE(judged.detail.find("but its success (solved"), std::string::npos) << judged.detail;
}

TEST(Answer, CountsACrashAsNoSuccess) {
  const Answer answer = AnswerOf(IkStudy(60), [](int trial) -> std::array<CellValues, 3> {
    return {{{1, 3}, {1, trial % 2 == 0 ? kNone : 1.0}, {1, 3}}};
  });
  EXPECT_EQ(answer.success->pairs, 60);
  EXPECT_EQ(answer.decided_by, AnswerStep::kSuccess);
  EXPECT_EQ(answer.verdict, Verdict::kWorse);
}

TEST(Answer, IsAboutTheValueWhereSuccessIsTheSame) {
  const auto world = [](int trial) -> std::array<CellValues, 3> { return {{{1, 3}, {1, 1 + 0.01 * trial}, {1, 3}}}; };
  const Answer answer = AnswerOf(IkStudy(100), world);
  EXPECT_EQ(answer.success->verdict, Verdict::kNoDifference);
  EXPECT_EQ(answer.verdict, Verdict::kBetter);
  EXPECT_EQ(answer.decided_by, AnswerStep::kValue);
  EXPECT_FALSE(answer.both_succeed) << "that is every world";
  // The control: if success is the only headline metric, values decide nothing.
  Study alone = IkStudy(100);
  alone.metrics = {"solved_practical"};
  EXPECT_EQ(AnswerOf(alone, world).verdict, Verdict::kNoDifference);
}

TEST(Answer, IsNotLeftOpenByASuccessThatNeverDiffers) {
  // 16 worlds are too few to exclude a difference of 5 points, but the two never differ, so values decide.
  const auto world_with = [](int lost) {
    return [lost](int trial) -> std::array<CellValues, 3> {
      return {{{1, 3}, {trial < lost ? 0.0 : 1.0, 3 + 1e-5 * (trial % 3)}, {1, 3}}};
    };
  };
  const Answer answer = AnswerOf(IkStudy(16), world_with(0));
  EXPECT_EQ(answer.success->verdict, Verdict::kUndecided);
  EXPECT_EQ(answer.verdict, Verdict::kNoDifference);
  // The control: one world is lost. Then the verdict stays open.
  const Answer open = AnswerOf(IkStudy(16), world_with(1));
  EXPECT_EQ(open.verdict, Verdict::kUndecided);
  EXPECT_EQ(open.beyond, Verdict::kUndecided);
}

TEST(Answer, IsAboutSuccessAloneWhereThatIsGradedAndComesFirst) {
  Study study = IkStudy(8);
  study.task = "coach";
  study.success = "retention";
  study.metrics = {"retention", "answered_share"};
  EXPECT_EQ(ValueMetricOf(study), "");
  study.metrics = {"answered_share", "retention"};
  EXPECT_EQ(ValueMetricOf(study), "answered_share");
  study.success = "solved_practical";
  study.metrics = {"solved_practical", "position_error_cm"};
  EXPECT_EQ(ValueMetricOf(study), "position_error_cm") << "yes or no: the value counts where both succeed";
}

TEST(Answer, IgnoresADifferenceOfSuccessThatDoesNotMatter) {
  // 12 of 400 worlds are lost: 3 points, p = 0.0002, below the threshold of 5 points.
  const auto world = [](int trial) -> std::array<CellValues, 3> {
    return {{{1, 3}, {trial < 12 ? 0.0 : 1.0, trial < 12 ? 3.5 : 1}, {1, 3}}};
  };
  Study study = IkStudy(400);
  EXPECT_EQ(AnswerOf(study, world).decided_by, AnswerStep::kValue);
  study.success_matters = 0.02;
  EXPECT_EQ(AnswerOf(study, world).decided_by, AnswerStep::kSuccess);
}

TEST(Answer, IsOpenWhereTheValueIsOppositeAmongThoseThatSucceed) {
  // a and b fail in different worlds, where their errors are large; b is worse where both succeed.
  const ScenarioSummary summary = SummaryOf(IkStudy(90), [](int trial) -> std::array<CellValues, 3> {
    if (trial < 54) return {{{trial % 2 == 0 ? 0.0 : 1.0, 9}, {trial % 2 == 0 ? 1.0 : 0.0, 2}, {1, 3}}};
    return {{{1, 1}, {1, 3 + 0.01 * trial}, {1, 3}}};
  });
  const ConditionSummary& condition = summary.conditions.front();
  EXPECT_EQ(condition.comparisons.front().verdict, Verdict::kBetter);
  const Answer& answer = condition.answers.front();
  EXPECT_EQ(answer.success->verdict, Verdict::kUndecided);
  EXPECT_EQ(answer.both_succeed->verdict, Verdict::kWorse);
  EXPECT_EQ(answer.verdict, Verdict::kUndecided);
  EXPECT_EQ(answer.decided_by, AnswerStep::kNone);
}

TEST(Answer, LooksAtTheTailLast) {
  // In 10 of 100 worlds b is 1 m off; neither the median nor the success shows it.
  const auto world = [](int trial) -> std::array<CellValues, 3> {
    return {{{1, 1}, {1, trial % 10 == 0 ? 100 : 1 + 0.001 * (trial % 3)}, {1, 1}}};
  };
  const Answer answer = AnswerOf(IkStudy(100), world);
  EXPECT_EQ(answer.decided_by, AnswerStep::kTail);
  EXPECT_EQ(answer.verdict, Verdict::kWorse);
  EXPECT_NEAR(*answer.tail->difference, -0.1, 1e-12);
  // The control: c equals a.
  const ScenarioSummary summary = SummaryOf(IkStudy(100), world);
  EXPECT_EQ(summary.conditions.front().answers[1].verdict, Verdict::kNoDifference);
}

TEST(Answer, OfTheTailHasItsOwnThreshold) {
  // b is far worse in 12 of 400 worlds: 3 %.
  const auto world = [](int trial) -> std::array<CellValues, 3> {
    return {{{1, 1}, {1, trial < 12 ? 100 : 1 + 0.001 * (trial % 3)}, {1, 1}}};
  };
  Study study = IkStudy(400);
  study.success_matters = 0.01;  // as in task evaluation
  EXPECT_EQ(AnswerOf(study, world).decided_by, AnswerStep::kNone);
  study.success_matters = 0.5;
  study.gate.tail.share = 0.02;
  EXPECT_EQ(AnswerOf(study, world).decided_by, AnswerStep::kTail);
}

TEST(Answer, AgainstTheStrongestRivalIsJudgedAlike) {
  const ScenarioSummary summary = SummaryOf(IkStudy(60), [](int trial) -> std::array<CellValues, 3> {
    return {{{1, 5}, {trial % 2 == 0 ? 1.0 : 0.0, 2}, {1, 3}}};
  });
  const std::vector<Answer>& answers = summary.conditions.front().rival_answers;
  const auto of_b = std::ranges::find(answers, "b", &Answer::method);
  ASSERT_NE(of_b, answers.end());
  EXPECT_EQ(of_b->baseline, "c");
  EXPECT_EQ(of_b->verdict, Verdict::kWorse);
  EXPECT_EQ(of_b->decided_by, AnswerStep::kSuccess);
}

}  // namespace
}  // namespace etude
