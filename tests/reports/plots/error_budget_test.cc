#include "reports/plots/plot_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/support/count_of.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ErrorBudget Budget() {
  return {.metric = "mpjpe_mm",
          .method = "<seen>",
          .is_shapley = false,
          .worlds = 12,
          .total = 40,
          .rest = 5,
          .shares = {{"marks", 38, 30, 44}, {"lengths", -3, -6, 1}, {"ik", 0}}};
}

TEST(ErrorBudgetHtml, HasABarForTheErrorForEveryStageAndForWhatIsLeft) {
  const std::string html = ErrorBudgetHtml(Budget(), "");
  EXPECT_EQ(CountOf(html, "<rect"), 5u);
  EXPECT_EQ(CountOf(html, "budget-interval"), 2u) << "one stage has none";
  EXPECT_EQ(CountOf(html, "budget worse"), 1u) << "with true lengths it is worse";
  EXPECT_THAT(html, HasSubstr("marks: 38.0 (30.0 to 44.0)"));
  EXPECT_THAT(html, HasSubstr("12 worlds"));
  EXPECT_THAT(html, Not(HasSubstr("<seen>"))) << "escaped";
}

TEST(ErrorBudgetHtml, SaysWhetherTheSharesDependOnAnOrder) {
  ErrorBudget budget = Budget();
  EXPECT_THAT(ErrorBudgetHtml(budget, "scene = 0.5"), HasSubstr("another order may give other values"));
  EXPECT_THAT(ErrorBudgetHtml(budget, "scene = 0.5"), HasSubstr("scene = 0.5"));
  budget.is_shapley = true;
  EXPECT_THAT(ErrorBudgetHtml(budget, ""), HasSubstr("Shapley values"));
}

}  // namespace
}  // namespace etude
