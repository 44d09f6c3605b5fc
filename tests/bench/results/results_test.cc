#include "tests/support/results.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "bench/model/recording.h"
#include "bench/results/folder.h"
#include "bench/results/row_json.h"
#include "bench/results/seal.h"
#include "bench/results/summary_json.h"
#include "io/files/files.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const Place kPlace{"cells.jsonl", 1, 0};

Row SampleRow() {
  Row row{"ik-weights", "ik", {{"joint_noise_deg", "10"}, {"noise", "gaussian"}}, 7, "builtin:clap", {},
          "adaptive",   {}};
  row.result.status = Status::kUnsolved;
  row.result.reason = "worst effector 0.8 cm";
  row.result.Measure("position_error_cm", 0.1 + 0.2);
  row.result.Missing("hidden_angle_error_deg", "no truth");
  row.result.digests = {{"problem", "00ff"}, {"solution", "11ee"}};
  row.result.series = {{"position_error_cm", "iteration", {3, 2, 1}}};
  BodyPose pose;
  pose[Role::kHead] = {0.1, 1.7, -0.3};
  row.result.recording = Recording{{{"truth", {30, {pose, pose}}}}, R"({"from":"clap"})"};
  return row;
}

TEST(Row, SurvivesTheWayToAFileAndBack) {
  const Row row = SampleRow();
  ASSERT_OK(back, DecodeRow(EncodeRow(row), kPlace));
  EXPECT_EQ(back->Id(), "ik-weights/joint_noise_deg=10,noise=gaussian/007/adaptive");
  EXPECT_EQ(back->result.status, Status::kUnsolved);
  EXPECT_EQ(back->result.reason, row.result.reason);
  ASSERT_EQ(back->result.metrics.size(), 2u);
  EXPECT_EQ(*back->result.metrics[0].value, 0.1 + 0.2);
  EXPECT_FALSE(back->result.metrics[1].value);
  EXPECT_EQ(back->result.metrics[1].null_reason, "no truth");
  EXPECT_EQ(back->result.digests, row.result.digests);
  EXPECT_EQ(*WriteJson(EncodeRow(*back)), *WriteJson(EncodeRow(row)));
}

TEST(Recording, NamesItsJointsAndRefusesThoseThatDoNot) {
  const Json json = *EncodeRecording(*SampleRow().result.recording);
  EXPECT_EQ(json.at("joints").at(3), "head");
  EXPECT_EQ(json.at("tracks").at(0).at("poses").at(0).at(3 * 3 + 1), 1.7);
  ASSERT_TRUE(DecodeRecording(json, kPlace));
  const auto complaint = [&](const std::function<void(Json&)>& change) {
    Json changed = json;
    change(changed);
    const auto read = DecodeRecording(changed, kPlace);
    return read ? "" : ToString(read.error());
  };
  const auto without_head = [](Json& changed) { changed = Json{{"tracks", changed.at("tracks")}, {"extras", {}}}; };
  EXPECT_THAT(complaint(without_head), HasSubstr("of version 1, which does not name its joints"));
  EXPECT_THAT(complaint([](Json& changed) { changed["recording"] = 3; }), HasSubstr("of version 3"));
  EXPECT_THAT(complaint([](Json& changed) { std::swap(changed["joints"][0], changed["joints"][1]); }),
              HasSubstr("'joints': "));
  EXPECT_THAT(complaint([](Json& changed) { changed["unit"] = "cm"; }), HasSubstr("'unit': \"cm\""));
  EXPECT_EQ(EncodeMotions(*SampleRow().result.recording)->size(), 2u) << "tracks and extras, as metrics are told them";
}

TEST(Row, IsFlatWithNumbersAsNumbers) {
  const Json json = EncodeRow(SampleRow());
  EXPECT_EQ(json.at("joint_noise_deg"), 10.0);
  EXPECT_EQ(json.at("noise"), "gaussian");
  EXPECT_EQ(json.at("status"), "unsolved");
  EXPECT_TRUE(json.at("hidden_angle_error_deg").is_null());
  EXPECT_EQ(json.at("digest_solution"), "11ee");
}

TEST(WriteJson, RefusesWhatJsonCannotHoldAndNamesItsPath) {
  const Json json{{"a", {1, {{"b", std::numeric_limits<double>::quiet_NaN()}}}}};
  EXPECT_EQ(testing::Message(WriteJson(json)), "/a/1/b is not a finite number");
}

MethodSummary SampleMethod() {
  MethodSummary method{.method = "a", .statuses = {{Status::kOk, 3}, {Status::kCrashed, 1}}};
  method.metrics = {{"position_error_cm", 3, 1, 2.0, 2.5, 1.0, 3.0, IntervalKind::kPercentile}};
  method.ok = 3;
  method.attempted = 4;
  method.ok_low = 0.3;
  method.ok_high = 0.95;
  return method;
}

/// Every field another value, so that two that are swapped show.
Comparison SampleComparison() {
  Comparison comparison;
  comparison.metric = "position_error_cm";
  comparison.baseline = "a";
  comparison.method = "b";
  comparison.pairs = 9;
  comparison.differing = 8;
  comparison.only_baseline = 1;
  comparison.only_method = 2;
  comparison.neither = 3;
  comparison.difference = -1.0;
  comparison.ci_low = -2.0;
  comparison.ci_high = -0.5;
  comparison.interval = IntervalKind::kAdjustedWald;
  comparison.mean = -1.1;
  comparison.mean_low = -2.1;
  comparison.mean_high = -0.6;
  comparison.signed_rank = {0.01, "exact"};
  comparison.sign_flip = {0.02, "9,999 draws"};
  comparison.p_holm = 0.04;
  comparison.better = 6;
  comparison.worse = 2;
  comparison.share_better = 0.9;
  comparison.effect_size = 0.8;
  comparison.verdict = Verdict::kBetter;
  comparison.why_open = "few";
  comparison.notes = {"missing", "mean"};
  Beyond& beyond = comparison.beyond;
  beyond.units = 7;
  beyond.differing = 6;
  beyond.difference = -1.2;
  beyond.low = -2.2;
  beyond.high = -0.7;
  beyond.mean = -1.25;
  beyond.mean_low = -2.3;
  beyond.mean_high = -0.8;
  beyond.test = {0.03, "t test"};
  beyond.p_holm = 0.05;
  beyond.verdict = Verdict::kNoDifference;
  beyond.why_open = "few clips";
  beyond.left_out = {{"clap", -1.3}, {"boxing", -1.4}};
  return comparison;
}

TEST(Summary, SurvivesTheWayToAFileAndBack) {
  ScenarioSummary scenario{"s", "ik", "q?", SamplingUnit::kClipPair, {"a", "b"}, {"position_error_cm"}, {}, {}, 12};
  Comparison empty;
  empty.metric = "position_error_cm";
  scenario.conditions.push_back({{{"x", "1"}}, {SampleMethod()}, {SampleComparison(), empty}, {empty}});
  Answer& answer = scenario.conditions[0].answers.emplace_back();
  answer = {.method = "b", .baseline = "a", .value_metric = "position_error_cm", .verdict = Verdict::kWorse};
  answer.decided_by = AnswerStep::kSuccess;
  answer.success = SampleComparison();
  scenario.expectations.push_back({"b below a", ClaimOutcome::kUndecided, "few"});
  const auto text = WriteJson(EncodeSummaries({scenario}));
  ASSERT_OK(back, DecodeSummaries(*ReadJson(*text, "x"), kPlace));
  EXPECT_EQ(*WriteJson(EncodeSummaries(*back)), *text);
  EXPECT_EQ((*back)[0].conditions[0].answers[0].decided_by, AnswerStep::kSuccess);
  EXPECT_EQ((*back)[0].conditions[0].answers[0].success->worse, 2);
  EXPECT_FALSE((*back)[0].conditions[0].answers[0].tail);
  const Comparison& comparison = (*back)[0].conditions[0].comparisons[0];
  EXPECT_EQ(comparison.verdict, Verdict::kBetter);
  EXPECT_EQ(comparison.interval, IntervalKind::kAdjustedWald);
  EXPECT_EQ(comparison.why_open, "few");
  EXPECT_EQ(comparison.notes, SampleComparison().notes);
  EXPECT_EQ(*comparison.p_holm, 0.04);
  const Beyond &beyond = comparison.beyond, sample = SampleComparison().beyond;
  EXPECT_EQ(beyond.differing, sample.differing);
  EXPECT_EQ(beyond.mean_low, sample.mean_low);
  EXPECT_EQ(beyond.verdict, sample.verdict);
  EXPECT_EQ(beyond.left_out[1].unit, "boxing");
  EXPECT_FALSE((*back)[0].conditions[0].rivals[0].beyond.verdict);
  EXPECT_EQ((*back)[0].unit, SamplingUnit::kClipPair);
  EXPECT_EQ((*back)[0].family, 12);
  EXPECT_EQ((*back)[0].conditions[0].methods[0].attempted, 4);
  EXPECT_FALSE((*back)[0].conditions[0].comparisons[1].difference);
}

TEST(Summary, KeepsErrorBudgetsAndSaysNothingWhereThereAreNone) {
  ScenarioSummary scenario;
  scenario.conditions.emplace_back();
  EXPECT_THAT(*WriteJson(EncodeSummaries({scenario})), ::testing::Not(::testing::HasSubstr("error_budgets")));
  scenario.conditions[0].budgets = {{.metric = "mpjpe_mm",
                                     .method = "seen",
                                     .is_shapley = true,
                                     .worlds = 12,
                                     .total = 40,
                                     .rest = 5,
                                     .shares = {{"marks", 38, 30, 44}, {"ik", -3}}}};
  const auto text = WriteJson(EncodeSummaries({scenario}));
  ASSERT_OK(back, DecodeSummaries(*ReadJson(*text, "x"), kPlace));
  EXPECT_EQ(*WriteJson(EncodeSummaries(*back)), *text);
  EXPECT_EQ((*back)[0].conditions[0].budgets[0].shares[0].ci_high, 44);
  EXPECT_FALSE((*back)[0].conditions[0].budgets[0].shares[1].ci_low);
}

TEST(LoadRun, NamesTheFileAndLineThatIsTorn) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "etude_torn_run";
  std::filesystem::remove_all(folder);
  EXPECT_THAT(ToString(LoadRun(folder).error()), HasSubstr("no such folder"));
  auto writer = ResultWriter::Begin(folder);
  ASSERT_TRUE(writer);
  ASSERT_TRUE(writer->Add(SampleRow(), {}));
  ASSERT_TRUE(writer->Finish({}));
  EXPECT_THAT(ToString(LoadRun(folder).error()), HasSubstr("is not a run, because it contains no manifest.json"));
  ASSERT_TRUE(WriteFileAtomically(folder / "manifest.json",
                                  fmt::format(R"({{"schema":{},"suite":"s","seed":1,"etude":"0"}})", kResultSchema)));
  ASSERT_TRUE(WriteFileAtomically(folder / "host.json", R"({"command_line":"c","host":"h","wall_seconds":1})"));
  EXPECT_THAT(ToString(LoadRun(folder).error()), HasSubstr("seal.json: is missing"));
  const auto load = [&] { return LoadRun(folder, Sealing::kIgnored); };
  ASSERT_TRUE(load()) << ToString(load().error());
  EXPECT_THAT(load()->unsealed, HasSubstr("seal.json: is missing"));
  EXPECT_TRUE(load()->cpu_seconds.empty()) << "a folder may tell of no times";
  ASSERT_TRUE(WriteFileAtomically(folder / "timings.jsonl", "{\"cell\":\"x\",\"cpu_s\":0.25}\n"));
  EXPECT_EQ(load()->cpu_seconds, (std::map<std::string, double>{{"x", 0.25}}));
  ASSERT_TRUE(WriteFileAtomically(folder / "timings.jsonl", "{\"cell\":\"x\",\"cpu_s\":0.25}\n{\"cell\":\"y\"}\n"));
  EXPECT_THAT(ToString(load().error()), HasSubstr("timings.jsonl:2: not a line of times"));
  std::filesystem::remove(folder / "timings.jsonl");
  std::ofstream(folder / "cells.jsonl", std::ios::app) << R"({"cell":"x","scen)";
  EXPECT_THAT(ToString(load().error()), HasSubstr("cells.jsonl:2: not valid JSON"));
  ASSERT_TRUE(WriteFileAtomically(folder / "manifest.json", R"({"schema":99})"));
  EXPECT_THAT(ToString(load().error()), HasSubstr(fmt::format("schema 99; this program reads {}", kResultSchema)));
}

TEST(Rows, NeverTakeASweptParameterForAMetricOfTheSameName) {
  Row row{"t", "transition", {{"wait_s", "0.5"}}, 0, "", {}, "fuzzy", CellResult::Ended(Status::kCrashed, "died")};
  ASSERT_OK(read, DecodeRow(EncodeRow(row), kPlace));
  EXPECT_EQ(ValueOf(*read, "wait_s"), std::nullopt);
  EXPECT_EQ(read->condition, row.condition);
}

TEST(Seal, HoldsUntilAnythingTheRunWroteChanges) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "etude_sealed_run";
  std::filesystem::remove_all(folder);
  const auto cells = folder / "cells.jsonl", series = folder / "series" / "ik.jsonl";
  ASSERT_TRUE(WriteFileAtomically(cells, "one\n"));
  ASSERT_TRUE(WriteFileAtomically(series, "two\n"));
  EXPECT_THAT(ToString(CheckSeal(folder).error()), HasSubstr("seal.json: is missing"));
  ASSERT_TRUE(SealRun(folder));
  EXPECT_TRUE(CheckSeal(folder));

  ASSERT_TRUE(WriteFileAtomically(folder / "report" / "index.html", "made from results"));
  ASSERT_TRUE(WriteFileAtomically(folder / "video" / "a.mp4", "likewise"));
  EXPECT_TRUE(CheckSeal(folder));

  ASSERT_TRUE(WriteFileAtomically(series, "twp\n"));
  EXPECT_THAT(ToString(CheckSeal(folder).error()), HasSubstr("ik.jsonl: was changed after the run wrote it"));
  std::filesystem::remove(series);
  EXPECT_THAT(ToString(CheckSeal(folder).error()), HasSubstr("ik.jsonl: is missing"));
  ASSERT_TRUE(WriteFileAtomically(series, "two\n"));
  ASSERT_TRUE(WriteFileAtomically(folder / "more.json", "{}"));
  EXPECT_THAT(ToString(CheckSeal(folder).error()), HasSubstr("more.json: was not written by the run"));
  std::filesystem::remove(folder / "more.json");
  EXPECT_TRUE(CheckSeal(folder));
  std::filesystem::create_directories(folder / "stray");
  EXPECT_THAT(ToString(CheckSeal(folder).error()), HasSubstr("stray/: was not written by the run"));
  std::filesystem::remove(folder / "stray");
  std::filesystem::create_symlink(cells, folder / "link.jsonl");
  EXPECT_THAT(ToString(CheckSeal(folder).error()), HasSubstr("link.jsonl: is neither a file nor a folder"));
  std::filesystem::remove(folder / "link.jsonl");
  EXPECT_TRUE(CheckSeal(folder));
  ASSERT_TRUE(WriteFileAtomically(folder / "seal.json", "{\"version\": 7}"));
  EXPECT_THAT(ToString(CheckSeal(folder).error()), HasSubstr("a seal of version 7"));
}

}  // namespace
}  // namespace etude
