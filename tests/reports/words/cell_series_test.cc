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

}  // namespace
}  // namespace etude
