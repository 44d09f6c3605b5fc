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

TEST(CompareRows, SeesARowUnderTheNameOfAnother) {
  const auto differs = [](auto change) {
    Row then = Example();
    then.units = {"clap", "sway"};
    Row now = then;
    change(then);
    return CompareRows(then, now).stage;
  };
  EXPECT_EQ(differs([](Row& row) { row.method = "rival"; }), "cell");
  EXPECT_EQ(differs([](Row& row) { row.trial = 4; }), "cell");
  EXPECT_EQ(differs([](Row& row) { row.condition = {{"noise", "5"}}; }), "cell");
  EXPECT_EQ(differs([](Row& row) { row.task = "ik"; }), "task");
  EXPECT_EQ(differs([](Row& row) { row.clip = "builtin:clap"; }), "clip");
  EXPECT_EQ(differs([](Row& row) { row.units = {"clap"}; }), "units");
  EXPECT_EQ(differs([](Row&) {}), "");
}

TEST(CompareRows, OfACellThatItsMachineEndedNameTheStatusFirst) {
  Row then = Example();
  then.result = CellResult::Ended(Status::kTimeout, "took longer than 1 s");
  const CellCheck check = CompareRows(then, Example());
  EXPECT_EQ(check.stage, "status");
  EXPECT_EQ(check.then, "timeout");
  EXPECT_EQ(check.now, "ok");
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
