#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "bench/scenario/scenario.h"
#include "bench/scenario/study_of.h"
#include "bench/statistics/summary.h"
#include "tests/bench/scenario/parse.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using Errors = std::function<double(const std::string& method, int trial)>;

constexpr const char* kWholeYaml = R"(
scenario: s
question: where from?
task: capture
clips: ['builtin:boxing']
trials: 12
methods:
- {name: seen, description: Sees all.}
- {name: m, oracle: [marks], description: Is told the marks.}
- {name: l, oracle: [lengths]}
- {name: ml, oracle: [lengths, marks]}
- {name: other, solver: ccd}
metrics: [mpjpe_mm]
)";

constexpr const char* kChainYaml = R"(
scenario: s
question: where from?
task: capture
clips: ['builtin:boxing']
trials: 12
methods:
- {name: seen}
- {name: m, oracle: [marks]}
- {name: mlp, oracle: [points, lengths, marks]}
- {name: aside, oracle: [calibration]}
metrics: [mpjpe_mm]
)";

std::vector<ErrorBudget> BudgetsOf(const Study& study, const Errors& errors) {
  ScenarioTable table(study);
  for (int trial = 0; trial < study.trials; ++trial) {
    for (const ComparedMethod& method : study.methods) {
      Row row{"s", "capture", {}, trial, "", {}, method.name, {}};
      row.result = CellResult::Ended(Status::kOk, "");
      const double error = errors(method.name, trial);
      if (error >= 0) row.result.Measure("mpjpe_mm", error);
      table.Add(row);
    }
  }
  return ComputeErrorBudgets(study, table.conditions()[0], "mpjpe_mm", 1);
}

const BudgetShare& ShareOf(const ErrorBudget& budget, const std::string& stage) {
  return *std::ranges::find(budget.shares, stage, &BudgetShare::stage);
}

// By hand: true marks reduce the error by 10 on their own and by 4 after true lengths; true lengths reduce it by 8 on
// their own and by 2 after true marks.
TEST(ErrorBudget, OfAllSubsetsAreShapleyValues) {
  const Study study = StudyOf(ParseOne(kWholeYaml));
  const auto budgets = BudgetsOf(study, [](const std::string& method, int trial) {
    const double rest = method == "seen" ? 20 : method == "m" ? 10 : method == "l" ? 12 : method == "ml" ? 8 : 99;
    return rest + trial % 3;
  });
  ASSERT_EQ(budgets.size(), 1u) << "the other solver is no family";
  const ErrorBudget& budget = budgets[0];
  EXPECT_TRUE(budget.is_shapley);
  EXPECT_EQ(budget.method, "seen");
  EXPECT_EQ(budget.worlds, 12);
  EXPECT_DOUBLE_EQ(budget.total, 21);
  EXPECT_DOUBLE_EQ(budget.rest, 9);
  EXPECT_DOUBLE_EQ(ShareOf(budget, "marks").mean, 7);
  EXPECT_DOUBLE_EQ(ShareOf(budget, "lengths").mean, 5);
}

TEST(ErrorBudget, OfSharesIsTheWholeWhateverTheErrors) {
  const Study study = StudyOf(ParseOne(kWholeYaml));
  const auto budget = BudgetsOf(study, [](const std::string& method, int trial) {
    return 30 + 10 * std::sin(static_cast<double>(method.size() * 7 + method[0]) + trial);
  })[0];
  double sum = budget.rest;
  for (const BudgetShare& share : budget.shares) {
    sum += share.mean;
    ASSERT_TRUE(share.ci_low && share.ci_high);
    EXPECT_LT(*share.ci_low, share.mean);
    EXPECT_GT(*share.ci_high, share.mean);
  }
  EXPECT_NEAR(sum, budget.total, 1e-9);
}

TEST(ErrorBudget, OfAChainIsStepByStep) {
  const Study study = StudyOf(ParseOne(kChainYaml));
  const auto budgets = BudgetsOf(study, [](const std::string& method, int) {
    return method == "seen" ? 20.0 : method == "m" ? 12.0 : method == "mlp" ? 1.0 : 19.0;
  });
  ASSERT_EQ(budgets.size(), 1u);
  EXPECT_FALSE(budgets[0].is_shapley);
  ASSERT_EQ(budgets[0].shares.size(), 2u);
  EXPECT_EQ(budgets[0].shares[0].stage, "marks");
  EXPECT_DOUBLE_EQ(budgets[0].shares[0].mean, 8);
  EXPECT_EQ(budgets[0].shares[1].stage, "lengths, points");
  EXPECT_DOUBLE_EQ(budgets[0].shares[1].mean, 11);
  EXPECT_DOUBLE_EQ(budgets[0].rest, 1);
}

TEST(ErrorBudget, CountsTheWorldsInWhichAllHaveAValue) {
  const Study study = StudyOf(ParseOne(kChainYaml));
  const auto budgets = BudgetsOf(study, [](const std::string& method, int trial) {
    if (method == "m" && trial < 4) return -1.0;
    return method == "seen" ? 20.0 + trial : 5.0;
  });
  ASSERT_EQ(budgets.size(), 1u);
  EXPECT_EQ(budgets[0].worlds, 8);
  EXPECT_DOUBLE_EQ(budgets[0].total, 27.5);
}

}  // namespace
}  // namespace etude
