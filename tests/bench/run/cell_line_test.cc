#include "bench/run/cell_line.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "bench/model/recording.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const Place kPlace{"journal.jsonl", 3, 0};

FinishedCell SampleCell() {
  FinishedCell cell{{"ik-weights", "ik", {{"noise", "gaussian"}}, 7, "", {}, "adaptive", {}},
                    {.wall_s = 0.25, .cpu_s = 1e-7, .peak_mb = 12, .world_wall_s = 3, .world_cpu_s = 0.1 + 0.2}};
  CellResult& result = cell.row.result;
  result.status = Status::kUnsolved;
  result.reason = "worst effector 0.8 cm, \"so\" far";
  result.Measure("position_error_cm", 0.1 + 0.2);
  result.Missing("hidden_angle_error_deg", "no truth\n");
  result.Measure("iterations", -0.0);
  result.Missing("orientation_error_deg", "");
  result.digests = {{"problem", "00ff"}, {"solution", "11ee"}};
  result.series = {{"position_error_cm", "iteration", {3, 2, 1e300}},
                   {"empty", "frame", {}},
                   {"named", "performance", {1}, {"clap", "a \"so\""}}};
  result.judged = {{"head", "root pelvis"}, 59.94, {{"iterations", 0.1 + 0.2}}};
  BodyPose pose;
  pose[Role::kHead] = {0.1, 1.7, -0.3};
  result.recording = Recording{{{"truth", {30, {pose, pose}}}}, R"({"from":"clap"})"};
  return cell;
}

Result<FinishedCell> ThereAndBack(const FinishedCell& cell) {
  Row identity;
  identity.scenario = "ik-weights";
  return DecodeCellLine(EncodeCellLine(12, cell), identity, kPlace);
}

TEST(CellLine, SaysAllThatACellIsAndTook) {
  const FinishedCell cell = SampleCell();
  ASSERT_OK(back, ThereAndBack(cell));
  const CellResult &was = cell.row.result, &is = back->row.result;
  EXPECT_EQ(back->row.scenario, "ik-weights");  // the identity comes from the plan, not from the line
  EXPECT_EQ(is.status, was.status);
  EXPECT_EQ(is.reason, was.reason);
  ASSERT_EQ(is.metrics.size(), was.metrics.size());
  for (std::size_t i = 0; i < was.metrics.size(); ++i) {
    EXPECT_EQ(is.metrics[i].id, was.metrics[i].id);
    EXPECT_EQ(is.metrics[i].value, was.metrics[i].value);
    EXPECT_EQ(is.metrics[i].null_reason, was.metrics[i].null_reason);
  }
  EXPECT_TRUE(std::signbit(*is.metrics[2].value));
  EXPECT_EQ(is.digests, was.digests);
  EXPECT_EQ(is.judged, was.judged);
  ASSERT_EQ(is.series.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(is.series[i].name, was.series[i].name);
    EXPECT_EQ(is.series[i].axis, was.series[i].axis);
    EXPECT_EQ(is.series[i].values, was.series[i].values);
    EXPECT_EQ(is.series[i].names, was.series[i].names);
  }
  EXPECT_EQ(is.recording->tracks[0].motion.poses[1][Role::kHead], glm::dvec3(0.1, 1.7, -0.3));
  EXPECT_EQ(back->usage.cpu_s, 1e-7);
  EXPECT_EQ(back->usage.world_cpu_s, 0.1 + 0.2);
  EXPECT_EQ(EncodeCellLine(12, *back), EncodeCellLine(12, cell));
}

TEST(CellLine, IsJsonInOneLine) {
  const std::string line = EncodeCellLine(12, SampleCell());
  EXPECT_EQ(line.find('\n'), std::string::npos);
  ASSERT_OK(json, ReadJson(line, "x"));
  EXPECT_EQ(json->at("cell"), 12);
  EXPECT_EQ(json->at("why"), Json::array({"no truth\n", ""}));
  EXPECT_EQ(json->at("series").at(1), Json::array({"empty", "frame", Json::array()}));
}

TEST(CellLine, OfACellThatMeasuredNothingIsShort) {
  FinishedCell cell;
  cell.row.result = CellResult::Ended(Status::kCrashed, "died");
  EXPECT_THAT(EncodeCellLine(0, cell),
              ::testing::StartsWith(R"({"cell":0,"status":"crashed","reason":"died","usage":)"));
  EXPECT_EQ(ThereAndBack(cell)->row.result.reason, "died");
}

TEST(CellLine, OfACellThatIsOkGivesNoReason) {
  FinishedCell cell;
  cell.row.result.status = Status::kOk;
  cell.row.result.reason = "";
  EXPECT_EQ(ThereAndBack(cell)->row.result.reason, "");
}

TEST(CellLine, TellsItsCellAndStatusFirst) {
  ASSERT_OK(head, ReadCellLineHead(EncodeCellLine(12, SampleCell())));
  EXPECT_EQ(head->cell, 12u);
  EXPECT_EQ(head->status, Status::kUnsolved);
}

TEST(CellLine, OfAnAnsweredCellSaysThatItHasYetToBeMeasured) {
  FinishedCell cell = SampleCell();
  cell.is_measured = false;
  const std::string line = EncodeCellLine(12, cell);
  EXPECT_THAT(line, ::testing::StartsWith(std::string(kAnsweredBegin) + "12,"));
  EXPECT_FALSE(ReadCellLineHead(line)->is_measured);
  EXPECT_EQ(ReadCellLineHead(line)->cell, 12u);
  auto back = ThereAndBack(cell);
  ASSERT_TRUE(back) << ToString(back.error());
  EXPECT_FALSE(back->is_measured);
  EXPECT_EQ(back->row.result.recording->tracks.size(), 1u);
  back->is_measured = true;
  EXPECT_EQ(EncodeCellLine(12, *std::move(back)), EncodeCellLine(12, SampleCell())) << "to every digit";
  // Values that cannot be written as JSON make the cell's output invalid. Such a cell counts as measured.
  cell.row.result.recording->tracks[0].motion.poses[0][Role::kSpine].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(ReadCellLineHead(EncodeCellLine(12, cell))->is_measured);
  EXPECT_EQ(ReadCellLineHead(EncodeCellLine(12, cell))->status, Status::kBadOutput);
}

TEST(CellLine, ThatIsNotAsItWasWrittenIsNone) {
  const std::string line = EncodeCellLine(12, SampleCell());
  for (std::size_t at = 0; at < line.size(); ++at) {
    std::string changed = line;
    changed[at] = static_cast<char>(changed[at] ^ 1);
    EXPECT_FALSE(ReadCellLineHead(changed)) << at;
    EXPECT_FALSE(DecodeCellLine(changed, {}, kPlace)) << at;
    EXPECT_FALSE(ReadCellLineHead(line.substr(0, at))) << at;
  }
  // Complete lines that this program would not write.
  for (const char* other :
       {"{}", "[1]", R"({"cell":1})", R"({"cell":1,"status":"happy"})", R"({"cell":-1,"status":"ok"})",
        R"({"cell":1,"status":"ok","usage":[1,2,3],"values":[999999,1]})",
        R"({"cell":1,"status":"ok","usage":[1,2,3],"more":1})",
        R"({"cell":1,"status":"ok","usage":[1,2,3],"recording":{}})"}) {
    EXPECT_FALSE(DecodeCellLine(WithSum(other), {}, kPlace)) << other;
  }
}

TEST(CellLine, WhoseStatusIsNoTextIsNone) {
  EXPECT_TRUE(ReadCellLineHead(WithSum(R"({"cell":1,"status":"o\u006b"})"))) << "the control";
  EXPECT_FALSE(ReadCellLineHead(WithSum(R"({"cell":1,"status":"o\q"})")));
  EXPECT_FALSE(ReadCellLineHead(WithSum("{\"cell\":1,\"status\":\"\xC2\\n\"}")));
}

TEST(CellLine, WithAValueThatIsNotFiniteIsBadOutput) {
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    FinishedCell metric = SampleCell(), series = SampleCell(), recording = SampleCell();
    metric.row.result.Measure("orientation_error_max_deg", bad);
    series.row.result.series[0].values[1] = bad;
    recording.row.result.recording->tracks[0].motion.poses[0][Role::kSpine].y = bad;
    for (const FinishedCell& cell : {metric, series, recording}) {
      ASSERT_OK(back, ThereAndBack(cell));
      EXPECT_EQ(back->row.result.status, Status::kBadOutput);
      EXPECT_THAT(back->row.result.reason, HasSubstr("finite"));
    }
  }
}

TEST(CellLine, WithAMetricThatNobodyDefinedIsBadOutput) {
  FinishedCell cell = SampleCell();
  cell.row.result.Measure("happiness", 1);
  EXPECT_THAT(ThereAndBack(cell)->row.result.reason, HasSubstr("'happiness' is not in the catalogue"));
}

}  // namespace
}  // namespace etude
