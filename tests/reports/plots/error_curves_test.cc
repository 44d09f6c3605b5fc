#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "reports/plots/plot_section.h"
#include "tests/reports/support/effector_run.h"
#include "tests/reports/support/example_run.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

TEST(ErrorCurves, IsDrawnOnlyFromCurvesAlongIterations) {
  RunData run = ExampleRun();
  AddRecordings(run);  // adds a curve over frames
  EXPECT_NE(ErrorCurvesHtml(run, run.scenarios[2]), "");
  EXPECT_EQ(ErrorCurvesHtml(run, run.scenarios[3]), "");
}

// A run of two tracking methods under two frame rates: errors of 1, 2, … mm, and ten times these.
RunData TrackingRun() {
  RunData run;
  ScenarioSummary& scenario = run.scenarios.emplace_back();
  scenario.name = "follow";
  scenario.task = "tracking";
  scenario.methods = {"slow", "quick"};
  scenario.headline_metrics = {"frames_solved", "mpjpe_mm"};
  for (const char* rate : {"30", "5"}) {
    scenario.conditions.emplace_back().condition = {{"rate_hz", rate}};
    for (const std::string& method : scenario.methods) {
      Row row;
      row.scenario = "follow";
      row.task = "tracking";
      row.method = method;
      row.condition = scenario.conditions.back().condition;
      const double size = method == "slow" ? 10 : 1;
      const std::vector<double> errors =
          rate == std::string("30") ? std::vector{size, 2 * size, 3 * size} : std::vector{99.0, 99.0};
      run.series.push_back({row.Id(),
                            {{"solved_practical", "frame", {1, 1, 1}},
                             {"position_error_cm", "frame", {7, 7, 7}},
                             {"mpjpe_mm", "frame", errors}}});
      run.rows.push_back(row);
    }
  }
  return run;
}

TEST(ErrorCurves, OfMotionsIsDrawnAlongTheFramesOfTheFirstCondition) {
  const RunData run = TrackingRun();
  const std::string html = ErrorCurvesHtml(run, run.scenarios.front());
  EXPECT_THAT(html, HasSubstr("<figcaption>Frame by frame: median of the joint error (MPJPE) (mm); lower is better; "
                              "under rate_hz=30</figcaption>"));
  EXPECT_THAT(html, HasSubstr("quick: from 1.00 mm to 3.00 mm in 2 frames. "));
  // The axis is linear from zero: equal differences are equal distances, for both methods.
  std::vector<double> heights;
  const std::regex point(R"([ "][0-9.]+,([0-9.]+))");
  for (auto it = std::sregex_iterator(html.begin(), html.end(), point); it != std::sregex_iterator(); ++it) {
    heights.push_back(std::stod((*it)[1]));
  }
  ASSERT_EQ(heights.size(), 6u);
  EXPECT_NEAR(heights[0] - heights[1], heights[1] - heights[2], 0.11);
  EXPECT_GT(*std::ranges::min_element(heights), 8.0);
}

TEST(ErrorCurves, TellTheValuesOfEveryStepUnderThePointer) {
  const RunData run = TrackingRun();
  const std::string html = ErrorCurvesHtml(run, run.scenarios.front());
  for (const char* title : {"<title>frame 0\nquick: 1.00 mm\nslow: 10.0 mm</title>",
                            "<title>frame 1\nquick: 2.00 mm\nslow: 20.0 mm</title>",
                            "<title>frame 2\nquick: 3.00 mm\nslow: 30.0 mm</title>"}) {
    EXPECT_THAT(html, HasSubstr(title));
  }
}

TEST(ErrorCurves, OfFarSmallerValuesAreLogarithmic) {
  RunData run = TrackingRun();
  for (CellSeries& cell : run.series) cell.series.back().values = {1000, 10, 0.1};
  const std::string html = ErrorCurvesHtml(run, run.scenarios.front());
  EXPECT_THAT(html, HasSubstr(">1k</text>"));
  EXPECT_THAT(html, HasSubstr(">0.1</text>"));
}

TEST(ErrorCurves, IsOfTheScenariosOwnMetricAndNeverOfWhatWasNotAskedFor) {
  RunData run = TrackingRun();
  run.scenarios.front().headline_metrics = {"angle_jerk_ratio"};
  EXPECT_THAT(ErrorCurvesHtml(run, run.scenarios.front()), HasSubstr("effector position error"));
  for (CellSeries& cell : run.series) std::ranges::fill(cell.series[1].values, 0);
  EXPECT_THAT(ErrorCurvesHtml(run, run.scenarios.front()), HasSubstr("joint error"));
  for (CellSeries& cell : run.series) cell.series.pop_back();
  EXPECT_EQ(ErrorCurvesHtml(run, run.scenarios.front()), "");
}

TEST(ErrorCurves, OfAMeanOverEffectorsIsThatOfTheWorst) {
  RunData run = TrackingRun();
  run.scenarios.front().headline_metrics = {"frames_solved", "orientation_error_deg", "mpjpe_mm"};
  for (CellSeries& cell : run.series) cell.series[1].name = "orientation_error_max_deg";
  EXPECT_THAT(ErrorCurvesHtml(run, run.scenarios.front()), HasSubstr("worst effector orientation error"));
}

TEST(ErrorCurves, IsTheSameWhateverCellsKeepOfSingleEffectors) {
  const RunData plain = ExampleRun();
  RunData with = EffectorRun();
  // Single effectors' curves come first, which must not matter either.
  for (CellSeries& cell : with.series) std::ranges::reverse(cell.series);
  EXPECT_EQ(ErrorCurvesHtml(with, with.scenarios[2]), ErrorCurvesHtml(plain, plain.scenarios[2]));
}

}  // namespace
}  // namespace etude
