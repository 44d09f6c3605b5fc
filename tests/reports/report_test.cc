#include "reports/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "io/files/files.h"
#include "tests/reports/support/effector_run.h"
#include "tests/reports/support/example_run.h"
#include "tests/support/gtest_printers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

fs::path FreshFolder() {
  const fs::path folder = fs::path(::testing::TempDir()) / "etude_reports" /
                          ::testing::UnitTest::GetInstance()->current_test_info()->name();
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

TEST(Report, WritesEveryFileAndLeavesNoPartialOne) {
  const fs::path run_folder = FreshFolder();
  ASSERT_OK(written, WriteReport(ExampleRun(), run_folder, {.pictures = false}));
  for (const char* name : {"index.html", "summary.md", "junit.xml", "tables/ik-weights.csv",
                           "tables/ik-weights-comparisons.csv", "tables/ik-weights.tex", "tables/capture.csv"}) {
    EXPECT_GT(fs::file_size(run_folder / "report" / name), 50u) << name;
  }
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(run_folder)) {
    files += entry.is_regular_file();
    EXPECT_EQ(entry.path().filename().string().find(".partial"), std::string::npos);
  }
  EXPECT_EQ(files, 3 + 3 * 4);
}

TEST(Report, WritesWhatCellsKeepOfSingleEffectorsWhereTheyDo) {
  const fs::path run_folder = FreshFolder();
  ASSERT_TRUE(WriteReport(EffectorRun(), run_folder, {.pictures = false}).has_value());
  EXPECT_TRUE(fs::exists(run_folder / "report/tables/ik-weights-paper-b.csv"));
  EXPECT_FALSE(fs::exists(run_folder / "report/tables/capture-paper-b.csv"));
}

TEST(Report, NamesThePathThatItCannotWrite) {
  const fs::path run_folder = FreshFolder();
  std::ofstream(run_folder / "report") << "a file stands where the folder should";
  EXPECT_THAT(testing::Refusal(WriteReport(ExampleRun(), run_folder, {.pictures = false})),
              HasSubstr((run_folder / "report").string()));
}

TEST(Report, KeepsTablesInTheirFolderWhateverAScenarioIsCalled) {
  RunData run = ExampleRun();
  run.scenarios.front().name = "../../escape";
  const fs::path run_folder = FreshFolder();
  ASSERT_TRUE(WriteReport(run, run_folder, {.pictures = false}).has_value());
  EXPECT_TRUE(fs::exists(run_folder / "report/tables/______escape-1.csv"));
}

TEST(Tables, LeaveMissingValuesEmpty) {
  RunData run = ExampleRun();
  MetricSummary& metric = run.scenarios[1].conditions[0].methods[0].metrics[0];
  metric = {metric.id, 0, 12, std::nullopt, std::nullopt, std::nullopt, std::nullopt};
  const fs::path run_folder = FreshFolder();
  ASSERT_TRUE(WriteReport(run, run_folder, {.pictures = false}).has_value());
  ASSERT_OK(csv, ReadWholeFile(run_folder / "report/tables/detection.csv"));
  EXPECT_THAT(*csv, HasSubstr("detection,,fixed,f1,,,,,,0,12,"));
}

TEST(Summary, SaysTheSameAsThePage) {
  const fs::path run_folder = FreshFolder();
  ASSERT_TRUE(WriteReport(ExampleRun(), run_folder, {.pictures = false}).has_value());
  ASSERT_OK(text, ReadWholeFile(run_folder / "report/summary.md"));
  EXPECT_THAT(*text, HasSubstr("3 of 5 expectations were met"));
  EXPECT_THAT(*text, HasSubstr("no bridge frame of “sway” has a partner"));
}

}  // namespace
}  // namespace etude
