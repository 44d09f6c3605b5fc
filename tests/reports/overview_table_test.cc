#include "reports/overview_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/reports/support/example_run.h"
#include "tests/reports/support/unit_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

ScenarioSummary TransitionScenario() { return ExampleRun().scenarios.front(); }

TEST(OverviewTable, ShowsEveryMethodByEveryHeadlineMetricWithItsVerdict) {
  const std::string html = OverviewTableHtml(TransitionScenario());
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">now</th><td class=\"n\">48.7 cm<span class=\"mark\"></span></td>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">fuzzy-bridge</th><td class=\"n\">29.6 cm<span class=\"mark\">"
                              "<b class=\"better\" role=\"img\" aria-label=\"better, on these clips only\">(▲)</b>"
                              "</span></td>"));
  EXPECT_THAT(html, Not(HasSubstr("Condition")));
  EXPECT_THAT(OverviewTableMarkdown(TransitionScenario()), HasSubstr("| fuzzy-bridge | 29.6 cm (▲) |"));
}

TEST(OverviewTable, HasNoSignWhereNothingWasComparedAndADashWhereNothingWasMeasured) {
  ScenarioSummary scenario = TransitionScenario();
  std::erase_if(scenario.conditions[0].comparisons, [](const Comparison& c) { return c.method == "wait-for-end"; });
  scenario.headline_metrics.push_back("sparc");
  const std::string text = OverviewTableMarkdown(scenario);
  EXPECT_THAT(text, HasSubstr("| wait-for-end (yardstick) | 50.1 cm | 50.1 s | — |"));
  EXPECT_THAT(OverviewTableHtml(scenario), HasSubstr("<tr class=\"yardstick\"><th scope=\"row\">wait-for-end"));
}

TEST(OverviewTable, NamesTheConditionOfEachRowAndKeepsNamesFromSpeakingMarkup) {
  ScenarioSummary scenario = TransitionScenario();
  scenario.conditions.push_back(scenario.conditions.front());
  scenario.conditions[0].condition = {{"threshold", "0.2"}};
  scenario.conditions[1].condition = {{"threshold", "<b>|x|"}};
  const std::string html = OverviewTableHtml(scenario);
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">now</th><td>threshold=0.2</td>"));
  EXPECT_THAT(html, Not(HasSubstr("<b>|")));
  EXPECT_THAT(OverviewTableMarkdown(scenario), Not(HasSubstr("<b>|x|")));
}

TEST(OverviewTable, IsNotNeededForOneMetric) {
  ScenarioSummary scenario = TransitionScenario();
  scenario.headline_metrics.resize(1);
  EXPECT_EQ(OverviewTableHtml(scenario), "");
  EXPECT_EQ(OverviewTableMarkdown(scenario), "");
}

TEST(OverviewTable, ShowsTheVerdictAgainstTheBestOtherBesideTheBaselines) {
  const std::string text = OverviewTableMarkdown(UnitRun().scenarios.front());
  EXPECT_THAT(text, HasSubstr("| now | 48.7 cm · ▼ |"));  // a baseline has none
  EXPECT_THAT(text, HasSubstr("| wait-for-end | 50.1 cm ? ▼ |"));
  EXPECT_THAT(text, HasSubstr("| gate-inertialised | 6.40 cm ▲ ▲ |"));
  EXPECT_THAT(text, HasSubstr("second: against the strongest other method"));
  EXPECT_THAT(OverviewTableMarkdown(UnitRun().scenarios[3]), HasSubstr("| ccd-adaptive | 47.8 mm (▲) (▲) |"));
}

}  // namespace
}  // namespace etude
