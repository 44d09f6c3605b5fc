#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reports/scenario_card.h"
#include "tests/reports/support/effector_run.h"
#include "tests/reports/support/example_run.h"
#include "tests/support/results.h"

namespace etude {
namespace {

TEST(CurveChart, IsDrawnOnlyFromCurvesAlongIterations) {
  RunData run = ExampleRun();
  AddRecordings(run);  // adds a curve over frames
  EXPECT_TRUE(CurveChart(run, run.scenarios[2]).has_value());
  EXPECT_FALSE(CurveChart(run, run.scenarios[3]).has_value());
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

TEST(CurveChart, OfMotionsIsDrawnAlongTheFramesOfTheFirstCondition) {
  const RunData run = TrackingRun();
  ASSERT_OK(chart, CurveChart(run, run.scenarios.front()));
  EXPECT_EQ(chart->caption,
            "Frame by frame: median of the joint error (MPJPE) (mm); lower is better; under rate_hz=30");
  const auto json = nlohmann::json::parse(chart->json);
  EXPECT_EQ(json["axis"], "frame");
  EXPECT_EQ(json["methods"][0]["values"], (nlohmann::json{10, 20, 30}));
  EXPECT_EQ(json["methods"][1]["values"], (nlohmann::json{1, 2, 3}));
}

TEST(CurveChart, IsOfTheScenariosOwnMetricAndNeverOfWhatWasNotAskedFor) {
  RunData run = TrackingRun();
  run.scenarios.front().headline_metrics = {"angle_jerk_ratio"};
  EXPECT_THAT(CurveChart(run, run.scenarios.front())->caption, ::testing::HasSubstr("effector position error"));
  for (CellSeries& cell : run.series) std::ranges::fill(cell.series[1].values, 0);
  EXPECT_THAT(CurveChart(run, run.scenarios.front())->caption, ::testing::HasSubstr("joint error"));
  for (CellSeries& cell : run.series) cell.series.pop_back();
  EXPECT_FALSE(CurveChart(run, run.scenarios.front()).has_value());
}

TEST(CurveChart, OfAMeanOverEffectorsIsThatOfTheWorst) {
  RunData run = TrackingRun();
  run.scenarios.front().headline_metrics = {"frames_solved", "orientation_error_deg", "mpjpe_mm"};
  for (CellSeries& cell : run.series) cell.series[1].name = "orientation_error_max_deg";
  EXPECT_THAT(CurveChart(run, run.scenarios.front())->caption,
              ::testing::HasSubstr("worst effector orientation error"));
}

TEST(CurveChart, IsTheSameWhateverCellsKeepOfSingleEffectors) {
  const RunData plain = ExampleRun();
  RunData with = EffectorRun();
  // Single effectors' curves come first, which must not matter either.
  for (CellSeries& cell : with.series) std::ranges::reverse(cell.series);
  EXPECT_EQ(CurveChart(with, with.scenarios[2])->json, CurveChart(plain, plain.scenarios[2])->json);
}

}  // namespace
}  // namespace etude
