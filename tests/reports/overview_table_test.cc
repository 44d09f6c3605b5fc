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
  const std::string html = OverviewTableHtml(ExampleRun(), TransitionScenario());
  EXPECT_THAT(html, HasSubstr("<tr data-ids=\"transition/-/000/now\"><th scope=\"row\">now</th><td class=\"n\" "
                              "data-v=\"48.7\">48.7 cm <small>"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">fuzzy-bridge</th><td class=\"n\" data-v=\"29.6\">29.6 cm <span "
                              "class=\"mark\"><b class=\"better\" role=\"img\" aria-label=\"better, on these clips "
                              "only\">(▲)</b></span> <small>"));
  EXPECT_THAT(html, Not(HasSubstr("Condition")));
  EXPECT_THAT(OverviewTableMarkdown(TransitionScenario()), HasSubstr("| fuzzy-bridge | 29.6 cm (▲) |"));
}

TEST(OverviewTable, HasNoSignWhereNothingWasComparedAndADashWhereNothingWasMeasured) {
  ScenarioSummary scenario = TransitionScenario();
  std::erase_if(scenario.conditions[0].comparisons, [](const Comparison& c) { return c.method == "wait-for-end"; });
  scenario.headline_metrics.push_back("sparc");
  const std::string text = OverviewTableMarkdown(scenario);
  EXPECT_THAT(text, HasSubstr("| wait-for-end (yardstick) | 50.1 cm | 50.1 s | — |"));
  EXPECT_THAT(OverviewTableHtml({}, scenario),
              HasSubstr("<tr class=\"yardstick\" data-ids=\"\"><th scope=\"row\">wait-for-end"));
}

TEST(OverviewTable, NamesTheConditionOfEachRowAndKeepsNamesFromSpeakingMarkup) {
  ScenarioSummary scenario = TransitionScenario();
  scenario.conditions.push_back(scenario.conditions.front());
  scenario.conditions[0].condition = {{"threshold", "0.2"}};
  scenario.conditions[1].condition = {{"threshold", "<b>|x|"}};
  const std::string html = OverviewTableHtml({}, scenario);
  EXPECT_THAT(html, HasSubstr("<th scope=\"row\">now</th><td>threshold=0.2</td>"));
  EXPECT_THAT(html, Not(HasSubstr("<b>|")));
  EXPECT_THAT(OverviewTableMarkdown(scenario), Not(HasSubstr("<b>|x|")));
}

TEST(OverviewTable, HidesOtherMetricsUntilTheyAreAskedFor) {
  ScenarioSummary scenario = TransitionScenario();
  scenario.headline_metrics.resize(1);
  const std::string html = OverviewTableHtml({}, scenario);
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\" class=\"n\" title=\"jump_cm\">"));
  EXPECT_THAT(html, HasSubstr("<th scope=\"col\" class=\"n more\" title=\"wait_s\">"));
  EXPECT_EQ(OverviewTableMarkdown(scenario), "");  // the answer already states the only headline metric
}

TEST(OverviewTable, SaysWhatIsMissingAndWhyThoseOfOneReasonTogether) {
  const std::string html = OverviewTableHtml(ExampleRun(), TransitionScenario());
  EXPECT_THAT(html, HasSubstr("<small>10 of 12</small>"));
  EXPECT_THAT(html, HasSubstr("<li>fuzzy-bridge, 2 of 12: 2 × no bridge frame"));
}

TEST(OverviewTable, PointsToARecordedCellWhereThereIsOne) {
  RunData run = ExampleRun();
  run.recordings.push_back({"transition/-/007/now", {}});
  EXPECT_THAT(OverviewTableHtml(run, TransitionScenario()),
              HasSubstr("<tr data-ids=\"transition/-/007/now\" data-cell=\"transition/-/007/now\">"));
}

TEST(OverviewTable, ShowsTheVerdictAgainstTheBestOtherBesideTheBaselines) {
  const std::string text = OverviewTableMarkdown(UnitRun().scenarios.front());
  EXPECT_THAT(text, HasSubstr("| now | 48.7 cm · ▼ |"));  // a baseline has no verdict
  EXPECT_THAT(text, HasSubstr("| wait-for-end | 50.1 cm ? ▼ |"));
  EXPECT_THAT(text, HasSubstr("| gate-inertialised | 6.40 cm ▲ ▲ |"));
  EXPECT_THAT(OverviewTableMarkdown(UnitRun().scenarios[3]), HasSubstr("| ccd-adaptive | 47.8 mm (▲) (▲) |"));
}

/// One pair of poses, which "fuzzy" calls alike and "joints" does not.
RunData OnePair(double called_alike) {
  RunData run;
  ScenarioSummary scenario{.name = "blind", .task = "pose-distance", .methods = {"fuzzy", "joints"}};
  scenario.conditions.resize(1);
  run.scenarios.push_back(scenario);
  const auto add = [&](const std::string& method, bool alike, double said) {
    Row row;
    row.scenario = "blind";
    row.task = "pose-distance";
    row.clip = "arm <forward> or |sideways|";
    row.method = method;
    row.result.Measure("pose_gap_cm", 103.2);
    row.result.Measure("called_alike", alike ? called_alike : 0);
    row.result.Measure(alike ? "fuzzy_distance" : "joint_distance_cm", said);
    row.result.Measure("false_smooth", alike);
    run.rows.push_back(std::move(row));
  };
  add("fuzzy", true, 0.0015);
  add("joints", false, 41.5);
  return run;
}

TEST(PosePairs, TellOfEveryPairHowFarApartItIsAndWhatEachMethodSays) {
  const RunData run = OnePair(1);
  const std::string html = PosePairsHtml(run, run.scenarios[0]);
  EXPECT_THAT(html, HasSubstr("arm &lt;forward&gt; or |sideways|</th><td class=\"n\">103 cm</td>"
                              "<td class=\"n\">✗ alike 0.002</td><td class=\"n\">apart 41.5 cm</td>"));
  const std::string text = PosePairsMarkdown(run, run.scenarios[0]);
  EXPECT_THAT(text, HasSubstr("| 103 cm | ✗ alike 0.002 | apart 41.5 cm |"));
  EXPECT_THAT(text, Not(HasSubstr("|sideways|")));
}

TEST(PosePairs, PutADashWhereAMethodSaysNothing) {
  RunData run = OnePair(1);
  run.rows.pop_back();
  EXPECT_THAT(PosePairsMarkdown(run, run.scenarios[0]), HasSubstr("0.002 | — |"));
}

TEST(PosePairs, AreNotToldOfWorldsOfManyPairsOfSweepsAndOfOtherTasks) {
  const RunData many = OnePair(0.4);
  EXPECT_EQ(PosePairsHtml(many, many.scenarios[0]), "");
  RunData run = OnePair(1);
  run.scenarios[0].conditions.resize(2);
  EXPECT_EQ(PosePairsMarkdown(run, run.scenarios[0]), "");
  run.scenarios[0].conditions.resize(1);
  run.scenarios[0].task = "transition";
  EXPECT_EQ(PosePairsHtml(run, run.scenarios[0]), "");
}

}  // namespace
}  // namespace etude
