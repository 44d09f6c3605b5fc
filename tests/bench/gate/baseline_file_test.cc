#include "bench/gate/baseline_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/gate/example.h"
#include "tests/support/kept_answers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using testing::AnswersAreKept;
using ::testing::AnyOf;
using testing::Edited;
using ::testing::HasSubstr;
using ::testing::StartsWith;

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

/// Returns the error message about a text. A wrong seal is accepted, because the seal of an edited text is always
/// wrong.
std::string ComplaintAbout(const std::string& text) {
  return testing::Refusal(ReadBaseline(text, "b.json", BaselineSeal::kMayBreak));
}

TEST(Baseline, ReadsBackToTheDigit) {
  ASSERT_OK(read, ReadBaseline(Text(), "b.json"));
  EXPECT_EQ(*WriteBaseline(*read), Text());
  const SnapshotCells& cells = read->scenarios[0].cells[1];
  EXPECT_EQ(cells.method, "b");
  EXPECT_EQ(cells.statuses, "ooou" + std::string(20, 'o'));
  EXPECT_EQ(cells.metrics[0].values[4], 14 + std::sqrt(2.0));
  EXPECT_EQ(cells.metrics[0].values[3], std::nullopt);
  EXPECT_EQ(read->scenarios[0].seed, 5u);
}

TEST(Baseline, KeepsWhatItsCellsWereJudgedOn) {
  Snapshot made = Example();
  SnapshotCells& cells = made.scenarios[0].cells[1];
  cells.judged.resize(24);
  cells.judged[0] = {{"head", "root pelvis"}, 30, {}};
  cells.judged[2] = {{"head"}, 25, {{"position_error_cm", 0.1 + 0.2}}};
  cells.judged[5] = cells.judged[0];
  const std::string text = *WriteBaseline(made);
  ASSERT_OK(read, ReadBaseline(text, "b.json"));
  EXPECT_EQ(read->scenarios[0].cells[1].judged, cells.judged);
  EXPECT_TRUE(read->scenarios[0].cells[0].judged.empty());
  EXPECT_EQ(*WriteBaseline(*read), text);
  EXPECT_THAT(ComplaintAbout(Edited(text, R"({"parts":1, => {"parts":7,)")), HasSubstr("'judged' of s, "));
  EXPECT_THAT(ComplaintAbout(Edited(text, R"("cells":[{"parts":0,"rate_hz":30.0},null, => "cells":[null,)")),
              HasSubstr("describes 23 cells, but the scenario has 24 trials"));
}

TEST(Baseline, HasOneLinePerMethodAndMetric) {
  const std::string text = Text();
  // Lines: head and brackets; statuses and two metrics of 2 × 2 cells; the scenario; 7 others; the seal.
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4 + 8 + 1 + 7 + 1);
  EXPECT_THAT(text,
              HasSubstr("\n{\"scenario\":\"s\",\"condition\":\"joint_noise_deg=1\",\"method\":\"a\",\"cells\":\"ooou"));
}

TEST(Baseline, IsRefusedWhenItsSealDoesNotFitAndReadWhereThatIsAskedFor) {
  const std::string edited = Edited(Text(), "[10.0, => [10.5,");
  EXPECT_THAT(testing::Refusal(ReadBaseline(edited, "b.json")),
              HasSubstr("b.json: the seal does not match, so this baseline was changed after gate --update wrote it"));
  ASSERT_OK(read, ReadBaseline(edited, "b.json", BaselineSeal::kMayBreak));
  EXPECT_THAT(read->unsealed, HasSubstr("the seal does not match"));
  EXPECT_EQ(ReadBaseline(Text(), "b.json")->unsealed, "");
  // A baseline of schema 1 has no seal.
  std::string older = Edited(Text(), R"("schema":2 => "schema":1)");
  older.erase(older.find(",\n\"seal\""));
  EXPECT_THAT(testing::Refusal(ReadBaseline(older + "}", "b.json")), HasSubstr("without a seal"));
  ASSERT_OK(unsealed, ReadBaseline(older + "}", "b.json", BaselineSeal::kMayBreak));
  EXPECT_THAT(unsealed->unsealed, HasSubstr("without a seal"));
  EXPECT_THAT(ComplaintAbout(Edited(Text(), R"("schema":2 => "schema":1)")), HasSubstr("has a 'seal'"));
  EXPECT_THAT(ComplaintAbout(Edited(older + "}", R"("schema":1 => "schema":2)")), HasSubstr("lacks its 'seal'"));
}

// The edits: duplicate, missing and unknown keys, values of other kinds, missing letters and numbers, too many nulls,
// and methods that failed everywhere.
TEST(Baseline, IsRefusedWithThePlaceWhenItIsNoneOrWouldHideSomething) {
  EXPECT_TRUE(AnswersAreKept("tests/bench/gate/complaints.txt",
                             [text = Text()](const std::string& line) { return ComplaintAbout(Edited(text, line)); }));
  const std::string ended = "ooou" + std::string(20, 'o');
  EXPECT_THAT(ComplaintAbout(testing::AllReplaced(Text(), ended, std::string(24, 's'))),
              HasSubstr("no cell has the status ok or unsolved"));
}

TEST(Baseline, HEAVY_ThatWasTornAnywhereIsRefusedInOneLineOrReadsAsAnotherOne) {
  const std::string text = Text();
  int refused = 0, tried = 0;
  for (std::size_t at = 0; at < text.size(); at += 3) {
    for (const std::string& put :
         {std::string(), std::string(2, text[at]), std::string("\""), std::string("7"), std::string("}")}) {
      const std::string complaint = ComplaintAbout(std::string(text).replace(at, 1, put));
      ++tried;
      refused += complaint != "accepted";
      EXPECT_EQ(complaint.find('\n'), std::string::npos);
      EXPECT_THAT(complaint, AnyOf("accepted", StartsWith("b.json")));
    }
  }
  EXPECT_GT(refused, tried / 2);
}

TEST(Baseline, IsRefusedWhenALineIsMissing) {
  std::string text = Text();
  const std::size_t from =
      text.find("\n{\"scenario\":\"s\",\"condition\":\"joint_noise_deg=1\",\"method\":\"a\",\"metric\"");
  ASSERT_NE(from, std::string::npos);
  text.erase(from, text.find('\n', from + 1) - from);
  EXPECT_THAT(ComplaintAbout(text), HasSubstr("contains 4 lines of statuses and 7 lines of values, but its scenarios "
                                              "need 4 lines of statuses and 8 lines of values"));
}

}  // namespace
}  // namespace etude
