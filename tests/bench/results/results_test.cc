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

using ::testing::ElementsAre;
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

TEST(Row, KeepsWhatItWasJudgedOn) {
  Row row = SampleRow();
  EXPECT_FALSE(EncodeRow(row).contains("judged"));
  row.result.judged = {{"head", "root pelvis"}, 59.94, {{"position_error_cm", 0.96}}};
  ASSERT_OK(back, DecodeRow(EncodeRow(row), kPlace));
  EXPECT_EQ(back->result.judged, row.result.judged);
}

TEST(Recording, NamesItsJointsAndRefusesThoseThatDoNot) {
  const Json json = *EncodeRecording(*SampleRow().result.recording);
  EXPECT_EQ(json.at("joints").at(3), "head");
  EXPECT_EQ(json.at("tracks").at(0).at("poses").at(0).at(3 * 3 + 1), 1.7);
  ASSERT_TRUE(DecodeRecording(json, kPlace));
  const auto complaint = [&](const std::function<void(Json&)>& change) {
    Json changed = json;
    change(changed);
    return testing::Refusal(DecodeRecording(changed, kPlace));
  };
  const auto without_head = [](Json& changed) { changed = Json{{"tracks", changed.at("tracks")}, {"extras", {}}}; };
  EXPECT_THAT(complaint(without_head), HasSubstr("of version 1, which does not list its joints"));
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

// Every field differs, so that swapped fields are noticed. The second scenario and condition lack optional fields.
TEST(Summary, SurvivesTheWayFromAFileAndBack) {
  ASSERT_OK(file, ReadJsonFile(std::filesystem::path("tests/bench/results/summary.json")));
  ASSERT_OK(scenarios, DecodeSummaries(*file, kPlace));
  EXPECT_EQ(EncodeSummaries(*scenarios), *file);
  // Earlier builds wrote another word for "undecided".
  std::string earlier = file->dump();
  const std::string_view word = "\"verdict\":\"undecided\"";
  const std::size_t place = earlier.find(word);
  ASSERT_NE(place, std::string::npos);
  earlier.replace(place, word.size(), "\"verdict\":\"inconclusive\"");
  ASSERT_OK(read, DecodeSummaries(Json::parse(earlier), kPlace));
  EXPECT_EQ(EncodeSummaries(*read), *file);
  const ScenarioSummary& scenario = scenarios->front();
  EXPECT_EQ(scenario.unit, SamplingUnit::kClipPair);
  EXPECT_EQ(scenario.family, 12);
  const ConditionSummary& condition = scenario.conditions[0];
  const MethodSummary& method = condition.methods[0];
  EXPECT_THAT(method.statuses, ElementsAre(::testing::Pair(Status::kOk, 3), ::testing::Pair(Status::kCrashed, 1)));
  EXPECT_EQ(method.attempted, 4);
  EXPECT_THAT((std::vector{*method.ok_low, *method.ok_high}), ElementsAre(0.3, 0.95));
  const MetricSummary& metric = method.metrics[0];
  EXPECT_THAT((std::vector{*metric.median, *metric.mean, *metric.ci_low, *metric.ci_high}), ElementsAre(2, 2.5, 1, 3));
  const Comparison& c = condition.comparisons[0];
  EXPECT_THAT((std::vector{c.pairs, c.differing, c.only_baseline, c.only_method, c.neither, c.better, c.worse}),
              ElementsAre(9, 8, 1, 2, 3, 6, 4));
  EXPECT_THAT((std::vector{*c.difference, *c.ci_low, *c.ci_high, *c.mean, *c.mean_low, *c.mean_high, *c.signed_rank.p,
                           *c.sign_flip.p, *c.p_holm, c.share_better, *c.effect_size}),
              ElementsAre(-1, -2, -0.5, -1.1, -2.1, -0.6, 0.01, 0.02, 0.04, 0.9, 0.8));
  EXPECT_EQ(c.interval, IntervalKind::kAdjustedWald);
  EXPECT_EQ(c.verdict, Verdict::kBetter);
  const Beyond& b = c.beyond;
  EXPECT_THAT((std::vector{b.units, b.differing}), ElementsAre(7, 5));
  EXPECT_THAT((std::vector{*b.difference, *b.low, *b.high, *b.mean, *b.mean_low, *b.mean_high, *b.test.p, *b.p_holm}),
              ElementsAre(-1.2, -2.2, -0.7, -1.25, -2.3, -0.8, 0.03, 0.05));
  EXPECT_EQ(b.left_out[1].unit, "boxing");
  EXPECT_FALSE(condition.rivals[0].beyond.verdict);
  EXPECT_EQ(condition.answers[0].decided_by, AnswerStep::kSuccess);
  EXPECT_EQ(condition.answers[0].success->worse, 4);
  EXPECT_FALSE(condition.answers[0].tail);
  EXPECT_EQ(condition.budgets[0].shares[0].ci_high, 44);
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

TEST(LoadRunRowByRow, GivesTheRowsCurvesAndTimesOfLoadRun) {
  const auto folder = std::filesystem::path(::testing::TempDir()) / "etude_streamed_run";
  std::filesystem::remove_all(folder);
  Row other = SampleRow();
  other.trial = 8;
  other.result.series.clear();
  Row last = SampleRow();
  last.trial = 9;
  last.result.series = {{"position_error_cm", "iteration", {5}}};
  auto writer = ResultWriter::Begin(folder);
  ASSERT_TRUE(writer);
  for (const Row& row : {SampleRow(), other, last}) ASSERT_TRUE(writer->Add(row, {}));
  ScenarioSummary summary;
  summary.name = "ik-weights";
  summary.task = "ik";
  ASSERT_TRUE(writer->Finish({summary}));
  ASSERT_TRUE(WriteFileAtomically(folder / "manifest.json",
                                  fmt::format(R"({{"schema":{},"suite":"s","seed":1,"etude":"0"}})", kResultSchema)));
  ASSERT_TRUE(WriteFileAtomically(folder / "host.json", R"({"command_line":"c","host":"h","wall_seconds":1})"));
  const std::string id = other.Id();
  const std::string times = fmt::format(R"({{"cell":"{}","cpu_s":0.25}})", id);
  ASSERT_TRUE(WriteFileAtomically(folder / "timings.jsonl", times + "\n"));
  ASSERT_OK(held, LoadRun(folder, Sealing::kIgnored));
  ASSERT_OK(streamed, LoadRunRowByRow(folder, Sealing::kIgnored));
  EXPECT_TRUE(streamed->rows.empty());
  ASSERT_EQ(CountRows(*streamed), 3u);
  std::size_t curves = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(*WriteJson(EncodeRow(RowAt(*streamed, i))), *WriteJson(EncodeRow(held->rows[i])));
    for (const Series& series : streamed->source->SeriesOf(i)) {
      EXPECT_EQ(series.values, held->series[curves].series[0].values);
      ++curves;
    }
    EXPECT_EQ(CpuSecondsOf(*streamed, held->rows[i], i), CpuSecondsOf(*held, held->rows[i], i));
  }
  EXPECT_EQ(curves, held->series.size());
  std::fstream file(folder / "cells.jsonl");
  file << "{{{";
  file.close();
  EXPECT_EQ(RowAt(*streamed, 0).scenario, "");
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
