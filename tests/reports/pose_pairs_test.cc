#include "reports/overview_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// One pair of poses, of which "fuzzy" says that they are alike and "joints" that they are not.
RunData OnePair(double called_alike) {
  RunData run;
  ScenarioSummary scenario;
  scenario.name = "blind";
  scenario.task = "pose-distance";
  scenario.methods = {"fuzzy", "joints"};
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
