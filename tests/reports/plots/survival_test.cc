#include "reports/plots/plot_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/support/count_of.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

RunData Solvers() {
  RunData run;
  ScenarioSummary& scenario = run.scenarios.emplace_back();
  scenario.name = "solve";
  scenario.methods = {"never", "quick"};
  scenario.conditions.emplace_back();
  for (int trial = 0; trial < 6; ++trial) {
    for (const std::string& method : scenario.methods) {
      Row row;
      row.scenario = "solve";
      row.trial = trial;
      row.method = method;
      row.result.status = method == "never" ? Status::kUnsolved : Status::kOk;
      row.result.Measure("iterations", method == "never" ? 200 : 3 + trial);
      row.result.Measure("solved_practical", method == "never" ? 0 : 1);
      run.rows.push_back(row);
    }
  }
  return run;
}

TEST(Survival, DrawsAMethodThatIsNeverDoneAsALineAtTheTop) {
  const RunData run = Solvers();
  const std::string html = SurvivalHtml(run, run.scenarios[0]);
  EXPECT_EQ(CountOf(html, "class=\"line\""), 2 + 2);  // curves and keys
  EXPECT_THAT(html, HasSubstr("aria-label=\"never: 100 % remain at the end. quick: 0 % remain at the end. \""));
}

TEST(Survival, IsDrawnOnlyWhereSomethingIsCensored) {
  RunData run = Solvers();
  std::erase_if(run.rows, [](const Row& row) { return row.method == "never"; });
  EXPECT_EQ(SurvivalHtml(run, run.scenarios[0]), "");
  run.rows.front().result = CellResult::Ended(Status::kTimeout, "too slow");  // a failure never finishes
  EXPECT_THAT(SurvivalHtml(run, run.scenarios[0]), HasSubstr("quick: 17 % remain at the end."));
  run.rows.front().result = CellResult::Ended(Status::kSkipped, "no labels");  // a skipped world does not count
  EXPECT_EQ(SurvivalHtml(run, run.scenarios[0]), "");
}

}  // namespace
}  // namespace etude
