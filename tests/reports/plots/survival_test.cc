#include "reports/plots/survival.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/support/count_of.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

TEST(NotYetDone, FallsAtEachTimeAndKeepsWhatNeverIs) {
  EXPECT_THAT(NotYetDone({{3}, {1}, {}, {3}}), ElementsAre(Pair(0, 100), Pair(1, 75), Pair(3, 25)));
  EXPECT_THAT(NotYetDone({{}, {}}), ElementsAre(Pair(0, 100)));
  EXPECT_TRUE(NotYetDone({}).empty());
}

// Kaplan and Meier's product over times, with censoring at a common limit: a second implementation.
TEST(NotYetDone, IsKaplanAndMeiersCurveWhereAllAreCensoredAtOneLimit) {
  const std::vector<Outcome> outcomes{{2}, {2}, {5}, {7}, {7}, {7}, {9}, {}, {}, {}};
  double share = 1;
  for (const auto& [at, left] : NotYetDone(outcomes)) {
    if (at == 0) continue;
    int at_risk = 0, done = 0;
    for (const Outcome& o : outcomes) {
      at_risk += !o.took || *o.took >= at;
      done += o.took == at;
    }
    share *= 1 - static_cast<double>(done) / at_risk;
    EXPECT_NEAR(left, 100 * share, 1e-9);
  }
}

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
  EXPECT_EQ(CountOf(html, "class=\"line\""), 2 + 2);  // curves, and keys
  EXPECT_THAT(html, HasSubstr("aria-label=\"never: 100 % never. quick: 0 % never. \""));
}

TEST(Survival, IsDrawnOnlyWhereSomethingIsCensored) {
  RunData run = Solvers();
  std::erase_if(run.rows, [](const Row& row) { return row.method == "never"; });
  EXPECT_EQ(SurvivalHtml(run, run.scenarios[0]), "");
  run.rows.front().result = CellResult::Ended(Status::kTimeout, "too slow");  // a failure is never done
  EXPECT_THAT(SurvivalHtml(run, run.scenarios[0]), HasSubstr("quick: 17 % never."));
  run.rows.front().result = CellResult::Ended(Status::kSkipped, "no labels");  // nothing that could be done
  EXPECT_EQ(SurvivalHtml(run, run.scenarios[0]), "");
}

}  // namespace
}  // namespace etude
