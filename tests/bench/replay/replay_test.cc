#include "bench/replay/replay.h"

#include <gtest/gtest.h>

namespace etude {
namespace {

Row Example() {
  Row row;
  row.scenario = "s";
  row.method = "m";
  row.result = CellResult::Ended(Status::kOk, "");
  row.result.digests = {{"world", "aa"}, {"pose", "bb"}, {"score", "cc"}};
  row.result.Measure("mpjpe_mm", 1.25);
  row.result.Missing("iou", "nobody there");
  return row;
}

TEST(CompareRows, FindsNothingInEqualRows) {
  const CellCheck check = CompareRows(Example(), Example());
  EXPECT_TRUE(check.same);
  EXPECT_EQ(check.stage, "");
}

TEST(CompareRows, NamesTheFirstStageThatDiffersEvenWhenLaterOnesDoToo) {
  Row now = Example();
  now.result.digests[2].second = now.result.digests[1].second = "xx";
  now.result.metrics.front().value = 2;
  const CellCheck check = CompareRows(Example(), now);
  EXPECT_FALSE(check.same);
  EXPECT_EQ(check.stage, "pose");
  EXPECT_EQ(check.then, "bb");
  EXPECT_EQ(check.now, "xx");
}

TEST(CompareRows, SeesAStageThatOnlyOneSideHas) {
  Row now = Example();
  now.result.digests.push_back({"extra", "dd"});
  EXPECT_EQ(CompareRows(Example(), now).stage, "extra");
  EXPECT_EQ(CompareRows(now, Example()).now, "nothing");
}

TEST(CompareRows, SeesAStatusAValueAndAMissingOne) {
  Row now = Example();
  now.result.status = Status::kTimeout;
  EXPECT_EQ(CompareRows(Example(), now).stage, "status");
  now = Example();
  now.result.metrics[0].value = 1.25 + 1e-15;
  EXPECT_EQ(CompareRows(Example(), now).stage, "mpjpe_mm");
  now = Example();
  now.result.metrics[1].value = 0;
  const CellCheck check = CompareRows(Example(), now);
  EXPECT_EQ(check.stage, "iou");
  EXPECT_EQ(check.then, "null (nobody there)");
  EXPECT_EQ(check.now, "0");
}

}  // namespace
}  // namespace etude
