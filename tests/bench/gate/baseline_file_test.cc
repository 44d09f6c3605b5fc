#include "bench/gate/baseline_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/gate/example.h"

namespace etude {
namespace {

using testing::HasSubstr;

Snapshot Example() {
  return TakeSnapshot(ExampleRun([](int trial, const std::string& method) {
    CellResult result = ExampleResult(trial, method == "a" ? 0 : std::sqrt(2.0));
    if (trial == 3) {
      result = CellResult::Ended(Status::kUnsolved, "far");
      result.Missing("position_error_cm", "none");
    }
    return result;
  }));
}

std::string Text() { return *WriteBaseline(Example()); }

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string ComplaintAbout(const std::string& text) {
  const auto read = ReadBaseline(text, "b.json");
  return read ? "" : ToString(read.error());
}

TEST(Baseline, ReadsBackToTheDigit) {
  const auto read = ReadBaseline(Text(), "b.json");
  ASSERT_TRUE(read) << ToString(read.error());
  EXPECT_EQ(*WriteBaseline(*read), Text());
  const SnapshotCells& cells = read->scenarios[0].cells[1];
  EXPECT_EQ(cells.method, "b");
  EXPECT_EQ(cells.statuses, "ooou" + std::string(20, 'o'));
  EXPECT_EQ(cells.metrics[0].values[4], 14 + std::sqrt(2.0));
  EXPECT_EQ(cells.metrics[0].values[3], std::nullopt);
  EXPECT_EQ(read->scenarios[0].seed, 5u);
}

TEST(Baseline, HasOneLinePerMethodAndMetric) {
  const std::string text = Text();
  // 2 conditions × 2 methods: statuses and two metrics each; one scenario; head, and four lines of brackets.
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4 + 8 + 1 + 7);
  EXPECT_THAT(text,
              HasSubstr("\n{\"scenario\":\"s\",\"condition\":\"joint_noise_deg=1\",\"method\":\"a\",\"cells\":\"ooou"));
}

TEST(Baseline, IsRefusedWhenAnythingOfItWasTamperedWith) {
  const std::string text = Text();
  EXPECT_EQ(ComplaintAbout(text), "");
  EXPECT_THAT(ComplaintAbout("{}"), HasSubstr("b.json: not a baseline"));
  EXPECT_THAT(ComplaintAbout("[1, 2"), HasSubstr("b.json: not valid JSON"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"schema\":1", "\"schema\":2")),
              HasSubstr("schema 2; this program reads 1"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "ooou", "ooo")), HasSubstr("are not 24 letters"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "ooou", "ooox")), HasSubstr("are not 24 letters"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "[10.0,", "[")), HasSubstr("23 values of position_error_cm"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "[10.0,", "[\"ten\",")), HasSubstr("not a baseline"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "[10.0,", "[1e999,")), HasSubstr("not valid JSON"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"trials\":24", "\"trials\":2000000000")), HasSubstr("allowed: 1…"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"position_error_cm\":1", "\"happiness\":1")),
              HasSubstr("unknown metric 'happiness'"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"method\":\"a\",\"cells\"", "\"method\":\"z\",\"cells\"")),
              HasSubstr("statuses of s, joint_noise_deg=1, z, which no scenario has"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"method\":\"a\",\"cells\"", "\"method\":\"b\",\"cells\"")),
              HasSubstr("two lines of statuses of s, joint_noise_deg=1, b"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"method\":\"a\",\"metric\"", "\"method\":\"b\",\"metric\"")),
              HasSubstr("two lines of position_error_cm"));
}

TEST(Baseline, IsRefusedWhenALineIsMissing) {
  std::string text = Text();
  const std::size_t from =
      text.find("\n{\"scenario\":\"s\",\"condition\":\"joint_noise_deg=1\",\"method\":\"a\",\"metric\"");
  ASSERT_NE(from, std::string::npos);
  text.erase(from, text.find('\n', from + 1) - from);
  EXPECT_THAT(ComplaintAbout(text), HasSubstr("4 lines of statuses and 7 of values; its scenarios have 4 and 8"));
}

}  // namespace
}  // namespace etude
