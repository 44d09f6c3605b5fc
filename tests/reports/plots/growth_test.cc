#include "reports/plots/growth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// Two methods at three sizes, three trials each: one looks at all frames, the other at their square root. A query of
/// the first takes a microsecond per frame and as many more as the trial's number.
RunData MakeRun(bool has_times = true) {
  RunData run;
  ScenarioSummary& scenario = run.scenarios.emplace_back();
  scenario.name = "s";
  scenario.task = "search";
  scenario.methods = {"loop <all>", "index"};
  for (const int frames : {100'000, 100, 10'000}) {  // in no order
    const std::vector<SweptValue> condition = {{"frames", std::to_string(frames)}};
    scenario.conditions.push_back({condition, {}, {}, {}});
    for (int trial = 0; trial < 3; ++trial) {
      for (const std::string& method : scenario.methods) {
        Row row;
        row.scenario = "s";
        row.task = "search";
        row.condition = condition;
        row.trial = trial;
        row.method = method;
        const double looked_at = method == "index" ? std::sqrt(frames) : frames;
        row.result.Measure("distances_per_query", looked_at);
        run.series.push_back({row.Id(), {{"matches_per_query", "query", std::vector<double>(50, 1.0)}}});
        if (has_times) run.cpu_seconds[row.Id()] = 50 * 1e-6 * (looked_at + trial);
        run.rows.push_back(std::move(row));
      }
    }
  }
  return run;
}

TEST(ComputeGrowth, GivesTheMedianOverTheTrialsBySizePerQuery) {
  const RunData run = MakeRun();
  const std::vector<Growth> growth = ComputeGrowth(run, run.scenarios[0]);
  ASSERT_EQ(growth.size(), 1u);
  EXPECT_EQ(growth[0].label, "");
  ASSERT_EQ(growth[0].distances.size(), 2u);
  const std::vector<GrowthPoint>& loop = growth[0].distances[0].points;
  ASSERT_EQ(loop.size(), 3u);
  EXPECT_EQ(loop[0].frames, 100);
  EXPECT_EQ(loop[2].frames, 100'000);
  EXPECT_NEAR(loop[1].value, 10'000, 1e-9);
  EXPECT_NEAR(growth[0].distances[1].points[1].value, 100, 1e-9);
  EXPECT_NEAR(growth[0].microseconds[0].points[0].value, 101, 1e-9) << "trials 0, 1 and 2: 100, 101, 102";
}

TEST(ComputeGrowth, KeepsApartWhatElseIsSwept) {
  RunData run = MakeRun();
  for (Row& row : run.rows) row.condition.push_back({"threshold", row.trial == 0 ? "0.2" : "0.4"});
  std::vector<ConditionSummary> conditions;
  for (const ConditionSummary& condition : run.scenarios[0].conditions) {
    for (const char* threshold : {"0.2", "0.4"}) {
      conditions.push_back(condition);
      conditions.back().condition.push_back({"threshold", threshold});
    }
  }
  run.scenarios[0].conditions = conditions;
  const std::vector<Growth> growth = ComputeGrowth(run, run.scenarios[0]);
  ASSERT_EQ(growth.size(), 2u);
  EXPECT_EQ(growth[1].label, "threshold=0.4");
  EXPECT_EQ(growth[1].distances[0].points.size(), 3u);
}

TEST(ComputeGrowth, HasNothingForOtherTasksAndNoTimesWhereNoneAreTold) {
  RunData run = MakeRun(false);
  const std::vector<Growth> growth = ComputeGrowth(run, run.scenarios[0]);
  EXPECT_EQ(growth[0].distances[0].points.size(), 3u);
  EXPECT_TRUE(growth[0].microseconds[0].points.empty());
  EXPECT_TRUE(ShowsGrowth(run.scenarios[0]));
  run.scenarios[0].task = "ik";
  EXPECT_TRUE(ComputeGrowth(run, run.scenarios[0]).empty());
  EXPECT_FALSE(ShowsGrowth(run.scenarios[0]));
  EXPECT_EQ(GrowthHtml(run, run.scenarios[0]), "");
}

// Closed form: on logarithmic axes proportional growth is a straight line.
TEST(GrowthPlot, DrawsEqualRatiosAsEqualDistances) {
  const std::string svg = GrowthPlotSvg({{0, {{100, 1}, {1000, 10}, {10'000, 100}}}}, "t");
  const std::size_t begin = svg.find(" points=\"") + 9;
  double x[3], y[3];
  ASSERT_EQ(std::sscanf(svg.c_str() + begin, "%lf,%lf %lf,%lf %lf,%lf", &x[0], &y[0], &x[1], &y[1], &x[2], &y[2]), 6);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.11);
  EXPECT_NEAR(y[1] - y[0], y[2] - y[1], 0.11);
  EXPECT_LT(y[2], y[0]) << "upwards";
  EXPECT_EQ(GrowthPlotSvg({{0, {}}}, "t"), "") << "nothing to draw";
  EXPECT_THAT(GrowthPlotSvg({{0, {{10, 10}}}}, "t"), Not(HasSubstr("nan"))) << "a single point has axes, too";
}

TEST(GrowthHtml, ShowsCurvesAndTableAndEscapesNames) {
  const RunData run = MakeRun();
  const std::string html = GrowthHtml(run, run.scenarios[0]);
  EXPECT_THAT(html, HasSubstr("loop &lt;all&gt;"));
  EXPECT_THAT(html, Not(HasSubstr("<all>")));
  EXPECT_THAT(html, HasSubstr("Distances computed per query"));
  EXPECT_THAT(html, HasSubstr("Processor time per query"));
  EXPECT_THAT(html, HasSubstr("<td class=\"n\">10,000 · 10,001 µs</td>"));
  const RunData untimed = MakeRun(false);
  EXPECT_THAT(GrowthHtml(untimed, untimed.scenarios[0]), Not(HasSubstr("figcaption>Processor time")));
}

}  // namespace
}  // namespace etude
