#include <gmock/gmock.h>

#include "bench/metrics/catalogue.h"
#include "bench/tasks/base/task_kinds.h"
#include "tests/bench/tasks/base/cell_values.h"
#include "tests/bench/tasks/search/search_fixture.h"
#include "tests/support/run_world.h"

namespace etude {
namespace {

using testing::HasSubstr;

std::vector<CellResult> CellsOf(const std::string& condition, const WorldKey& key = kSearchWorld) {
  const auto task = MakeSearch(condition);
  EXPECT_TRUE(task) << ToString(task.error());
  return RunWorld(**task, key, kSearchMethodCount);
}

/// Of a single method.
CellResult CellOf(const std::string& condition, const std::string& method) {
  return RunWorld(**MakeSearch(condition, "[{name: it, " + method + "}]"), kSearchWorld, 1)[0];
}

TEST(SearchTask, GivesEveryMethodACellWithAllMetricsAndEveryAnswerRight) {
  const TaskKind kind = MakeSearchTaskKind();
  for (const CellResult& cell : CellsOf("{frames: 1000, queries: 40}")) {
    EXPECT_EQ(cell.status, Status::kOk) << cell.reason;
    ASSERT_EQ(cell.metrics.size(), kind.metrics.size());
    for (std::size_t i = 0; i < kind.metrics.size(); ++i) {
      EXPECT_EQ(cell.metrics[i].id, kind.metrics[i]);
      EXPECT_NE(FindMetric(kind.metrics[i]), nullptr) << kind.metrics[i];
    }
    EXPECT_EQ(ValueOf(cell, "search_agreement"), 1);
    EXPECT_EQ(cell.digests.size(), 3u);
  }
}

TEST(SearchTask, IndexAndLoopFindTheSameAndTheLoopLooksAtEveryFrame) {
  const std::vector<CellResult> cells = CellsOf("{frames: 1000, queries: 40}");
  for (std::size_t m = 0; m < cells.size(); m += 2) {
    EXPECT_EQ(cells[m].digests, cells[m + 1].digests);
    EXPECT_EQ(ValueOf(cells[m], "matches_per_query"), ValueOf(cells[m + 1], "matches_per_query"));
    EXPECT_TRUE(ValueOf(cells[m], "boxes_per_query"));
    EXPECT_FALSE(ValueOf(cells[m + 1], "boxes_per_query")) << "a loop has no boxes";
  }
  EXPECT_LT(*ValueOf(cells[1], "distances_per_query"), 1000) << "it ends at the first match";
  for (const std::size_t m : {3, 5, 7}) EXPECT_EQ(ValueOf(cells[m], "distances_per_query"), 1000);
  EXPECT_EQ(ValueOf(cells[5], "matches_per_query"), 1);
  EXPECT_EQ(ValueOf(cells[7], "matches_per_query"), 10);
}

TEST(SearchTask, TheIndexLooksAtFewerFramesThanTheLoopAndGainsAsTheLibraryGrows) {
  const auto share_of = [](const char* condition, double frames) {
    return *ValueOf(CellOf(condition, "query: nearest"), "distances_per_query") / frames;
  };
  const double small = share_of("{frames: 1000, queries: 50}", 1000);
  const double large = share_of("{frames: 10000, queries: 50}", 10'000);
  EXPECT_LT(large, 0.5);
  EXPECT_LT(large, small);
}

TEST(SearchTask, AWiderThresholdFindsMore) {
  const auto found = [](const std::string& threshold) {
    const CellResult cell = CellOf("{frames: 500, queries: 30, threshold: " + threshold + "}", "query: within");
    return *ValueOf(cell, "matches_per_query");
  };
  EXPECT_EQ(found("0"), 0);
  EXPECT_LT(found("0.2"), found("0.8"));
  EXPECT_EQ(found("6"), 500);
}

TEST(SearchTask, RepeatsItselfToTheLastBitAndAsksAnotherWorldOtherwise) {
  const WorldKey other{.suite_seed = 1, .scenario = "test", .trial = 1};
  const char* const condition = "{frames: 1000, queries: 20}";
  const CellResult cell = CellsOf(condition)[4];
  EXPECT_EQ(cell.digests, CellOf(condition, "query: nearest").digests) << "whoever else runs there";
  const CellResult elsewhere = CellsOf(condition, other)[4];
  EXPECT_EQ(cell.digests[0], elsewhere.digests[0]) << "one library";
  EXPECT_NE(cell.digests[1], elsewhere.digests[1]);
}

TEST(SearchTask, RefusesWhatItDoesNotKnowAndSaysWhereItStands) {
  const auto complaint = [](const std::string& condition, const std::string& methods = kSearchMethods) {
    const auto task = MakeSearch(condition, methods);
    return task ? "" : ToString(task.error());
  };
  EXPECT_EQ(complaint("{frames: 1000, query: first, threshold: 0.3}", "[{name: a}]"), "");
  EXPECT_THAT(complaint("{frames: 9}"), HasSubstr("test.yaml:1:10"));
  EXPECT_THAT(complaint("{frames: 1e9}"), HasSubstr("1000000"));
  EXPECT_THAT(complaint("{query: nearst}"), HasSubstr("did you mean 'nearest'"));
  EXPECT_THAT(complaint("{}", "[{name: a, search: indx}]"), HasSubstr("did you mean 'index'"));
  EXPECT_THAT(complaint("{}", "[{name: a, serach: index}]"), HasSubstr("search"));
  const auto no_clips = MakeSearch("{}", kSearchMethods, {});
  ASSERT_FALSE(no_clips);
  EXPECT_THAT(ToString(no_clips.error()), HasSubstr("needs clips"));
}

}  // namespace
}  // namespace etude
