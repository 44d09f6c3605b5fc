#include "reports/words/cell_series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/support/example_run.h"

namespace etude {
namespace {

TEST(MedianCurve, LetsACurveThatEndedKeepItsLastValue) {
  const std::vector<double> stops{9, 1}, goes_on{9, 5, 4, 3}, slow{9, 8, 7, 6};
  EXPECT_THAT(MedianCurve({&stops, &goes_on, &slow}), ::testing::ElementsAre(9, 5, 4, 3));
  EXPECT_THAT(MedianCurve({&stops, &goes_on}), ::testing::ElementsAre(9, 3, 2.5, 2));
  EXPECT_THAT(MedianCurve({}), ::testing::IsEmpty());
}

TEST(CellSeriesIndex, FindsOnlyWhatThatCellKeeps) {
  const RunData run = ExampleRun();
  const CellSeriesIndex series(run);
  int found = 0;
  for (const Row& row : run.rows) {
    const std::vector<double>* values = series.Find(row, "orientation_error_deg");
    EXPECT_EQ(values != nullptr, row.scenario == "ik-weights");
    found += values != nullptr;
    EXPECT_EQ(series.Find(row, "orientation_error"), nullptr);
  }
  EXPECT_EQ(found, 4 * 3 * 12);
  EXPECT_TRUE(KeepsSeries(run, run.scenarios[2], "orientation_error_deg"));
  EXPECT_FALSE(KeepsSeries(run, run.scenarios[1], "orientation_error_deg"));
}

TEST(RowsUnder, AreAllThatAWalkOverEveryRowFinds) {
  const RunData run = ExampleRun();
  std::size_t found = 0;
  for (const ScenarioSummary& scenario : run.scenarios) {
    for (const ConditionSummary& condition : scenario.conditions) {
      std::vector<const Row*> expected;
      for (const Row& row : run.rows) {
        if (row.scenario == scenario.name && row.condition == condition.condition) expected.push_back(&row);
      }
      EXPECT_EQ(RowsUnder(run, scenario.name, condition.condition), expected);
      found += expected.size();
    }
  }
  EXPECT_EQ(found, run.rows.size());
  EXPECT_THAT(RowsUnder(run, "none", {}), ::testing::IsEmpty());
}

TEST(RecordedRows, KeepTheOrderOfRecordingsAndLeaveOutThoseWithoutACell) {
  RunData run = ExampleRun();
  run.recordings.clear();
  for (const std::string& cell : {run.rows[30].Id(), run.rows[2].Id(), std::string("none/-/0/none")}) {
    run.recordings.push_back({cell, {}});
  }
  const auto recorded = RecordedRows(run);
  ASSERT_EQ(recorded.size(), 2);
  EXPECT_EQ(recorded[0], std::pair(&std::as_const(run.rows)[30], &std::as_const(run.recordings)[0]));
  EXPECT_EQ(recorded[1], std::pair(&std::as_const(run.rows)[2], &std::as_const(run.recordings)[1]));
}

}  // namespace
}  // namespace etude
