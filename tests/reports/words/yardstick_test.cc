#include "reports/words/judged.h"

#include <gtest/gtest.h>

#include "reports/words/figures.h"
#include "reports/words/findings.h"
#include "tests/reports/support/example_run.h"

namespace etude {
namespace {

TEST(Yardstick, IsAMethodThatIsComparedWithNone) {
  const RunData run = ExampleRun();
  ScenarioSummary scenario = run.scenarios.front();
  for (const std::string& method : scenario.methods) EXPECT_FALSE(IsYardstick(scenario, method)) << method;
  std::erase_if(scenario.conditions[0].comparisons, [](const Comparison& c) { return c.method == "wait-for-end"; });
  EXPECT_TRUE(IsYardstick(scenario, "wait-for-end"));
  EXPECT_EQ(MethodLabel(scenario, "wait-for-end"), "wait-for-end (yardstick)");
  EXPECT_EQ(MethodLabel(scenario, "now"), "now");

  const ScenarioFindings findings = FindingsOf(run, scenario);
  EXPECT_EQ(findings.yardsticks, std::vector<std::string>{"wait-for-end"});
  EXPECT_EQ(findings.methods.size(), 3u);
  EXPECT_EQ(findings.answer.method, "fuzzy-bridge");  // the next one answers the question
}

TEST(Yardstick, IsNobodysBaseline) {
  ScenarioSummary scenario = ExampleRun().scenarios.front();
  std::vector<Comparison>& comparisons = scenario.conditions[0].comparisons;
  std::erase_if(comparisons, [](const Comparison& c) { return c.method == "wait-for-end"; });
  comparisons.front().baseline = "wait-for-end";
  EXPECT_FALSE(IsYardstick(scenario, "wait-for-end"));
  EXPECT_TRUE(IsComparedWithNone(scenario, "wait-for-end"));
  const ScenarioFindings findings = FindingsOf(ExampleRun(), scenario);
  EXPECT_TRUE(findings.yardsticks.empty());
  EXPECT_EQ(findings.methods.size(), 3u);  // nor does it get a verdict
}

TEST(Yardstick, IsNobodyWhereNothingIsCompared) {
  ScenarioSummary scenario = ExampleRun().scenarios.front();
  scenario.conditions[0].comparisons.clear();
  scenario.headline_metrics.clear();
  EXPECT_FALSE(IsYardstick(scenario, "wait-for-end"));
}

TEST(LeftOut, IsSaidOnlyWhenSomethingIs) {
  EXPECT_EQ(LeftOutWords(40, 40, "methods", "a file"), "");
  EXPECT_EQ(LeftOutWords(1240, 40, "methods", "a file"), "1,200 more methods are left out here; a file has all.");
  EXPECT_EQ(LeftOutHtml(41, 40, "methods", "<a>"),
            "<p class=\"quiet legend\">1 more methods are left out here; &lt;a&gt; has all.</p>");
}

}  // namespace
}  // namespace etude
