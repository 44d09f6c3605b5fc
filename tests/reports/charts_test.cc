#include "reports/charts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/reports/support/effector_run.h"
#include "tests/reports/support/example_run.h"

namespace etude {
namespace {

TEST(IntervalChart, HasAMarkForEveryMethodUnderEveryCondition) {
  const RunData run = ExampleRun();
  const auto chart = IntervalChart(run.scenarios[2]);
  ASSERT_TRUE(chart.has_value());
  const auto json = nlohmann::json::parse(chart->json);
  EXPECT_EQ(json["groups"], (nlohmann::json{"5", "10", "20"}));
  EXPECT_EQ(json["groupLabel"], "joint_noise_deg");
  ASSERT_EQ(json["methods"].size(), 4u);
  for (const auto& method : json["methods"]) EXPECT_EQ(method["marks"].size(), 3u);
  EXPECT_DOUBLE_EQ(json["methods"][0]["marks"][1]["value"], 14.2);
  EXPECT_DOUBLE_EQ(json["methods"][0]["marks"][1]["low"], 13.1);
}

TEST(IntervalChart, DrawsNothingRatherThanZeroForAMissingValue) {
  RunData run = ExampleRun();
  MetricSummary& metric = run.scenarios[1].conditions[0].methods[1].metrics[0];
  metric.median = metric.mean = metric.ci_low = metric.ci_high = std::nullopt;
  const auto json = nlohmann::json::parse(IntervalChart(run.scenarios[1])->json);
  EXPECT_TRUE(json["methods"][1]["marks"][0]["value"].is_null());
  metric = run.scenarios[1].conditions[0].methods[0].metrics[0];
  for (auto& method : run.scenarios[1].conditions[0].methods) {
    MetricSummary& missing = method.metrics[0];
    missing.median = missing.mean = missing.ci_low = missing.ci_high = std::nullopt;
  }
  EXPECT_FALSE(IntervalChart(run.scenarios[1]).has_value());
}

TEST(ConvergenceChart, IsDrawnOnlyFromCurvesAlongIterations) {
  RunData run = ExampleRun();
  AddRecordings(run);  // brings a curve along frames
  EXPECT_TRUE(ConvergenceChart(run, run.scenarios[2]).has_value());
  EXPECT_FALSE(ConvergenceChart(run, run.scenarios[3]).has_value());
}

TEST(ConvergenceChart, IsTheSameWhateverCellsKeepOfSingleEffectors) {
  const RunData plain = ExampleRun();
  RunData with = EffectorRun();
  // Even when the effectors' curves come first.
  for (CellSeries& cell : with.series) std::ranges::reverse(cell.series);
  EXPECT_EQ(ConvergenceChart(with, with.scenarios[2])->json, ConvergenceChart(plain, plain.scenarios[2])->json);
}

}  // namespace
}  // namespace etude
