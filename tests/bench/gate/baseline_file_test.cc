#include "bench/gate/baseline_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/bench/gate/example.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

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

/// Of all but the seal, which an edited text never fits.
std::string ComplaintAbout(const std::string& text) {
  const auto read = ReadBaseline(text, "b.json", BaselineSeal::kMayBreak);
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
  // 2 conditions × 2 methods: statuses and two metrics each; one scenario; head, and four lines of brackets; the seal.
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4 + 8 + 1 + 7 + 1);
  EXPECT_THAT(text,
              HasSubstr("\n{\"scenario\":\"s\",\"condition\":\"joint_noise_deg=1\",\"method\":\"a\",\"cells\":\"ooou"));
}

TEST(Baseline, IsRefusedWhenAnythingOfItWasTamperedWith) {
  const std::string text = Text();
  EXPECT_EQ(ComplaintAbout(text), "");
  EXPECT_THAT(ComplaintAbout("{}"), HasSubstr("b.json: a baseline lacks 'schema'"));
  EXPECT_THAT(ComplaintAbout("[]"), HasSubstr("b.json: a baseline must be an object, found an empty list"));
  EXPECT_THAT(ComplaintAbout("[1, 2"), HasSubstr("b.json: not valid JSON"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"schema\":2", "\"schema\":3")),
              HasSubstr("b.json: schema 3; allowed: 1 and 2"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "ooou", "ooo")), HasSubstr("are not 24 letters"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "ooou", "ooox")), HasSubstr("are not 24 letters"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "[10.0,", "[")), HasSubstr("23 values of position_error_cm"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "[10.0,", "[\"ten\",")),
              HasSubstr("b.json:12: the value of position_error_cm of s, joint_noise_deg=1, a in trial 0 is 'ten'; "
                        "allowed: a number or null"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "[10.0,", "[1e999,")), HasSubstr("not valid JSON"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"trials\":24", "\"trials\":2000000000")),
              HasSubstr("b.json:3: 'trials' of a scenario is 2000000000; allowed: a whole number, 1…1000000"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"position_error_cm\":1", "\"happiness\":1")),
              HasSubstr("unknown metric 'happiness'"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"method\":\"a\",\"cells\"", "\"method\":\"z\",\"cells\"")),
              HasSubstr("statuses of s, joint_noise_deg=1, z, which no scenario has"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"method\":\"a\",\"cells\"", "\"method\":\"b\",\"cells\"")),
              HasSubstr("two lines of statuses of s, joint_noise_deg=1, b"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"method\":\"a\",\"metric\"", "\"method\":\"b\",\"metric\"")),
              HasSubstr("two lines of position_error_cm"));
}

TEST(Baseline, IsRefusedWhenItsSealDoesNotFitAndReadWhereThatIsAskedFor) {
  const std::string edited = Replaced(Text(), "[10.0,", "[10.5,");
  const auto refused = ReadBaseline(edited, "b.json");
  ASSERT_FALSE(refused);
  EXPECT_THAT(ToString(refused.error()),
              HasSubstr("b.json: was changed after gate --update wrote it: its seal does not match"));
  const auto read = ReadBaseline(edited, "b.json", BaselineSeal::kMayBreak);
  ASSERT_TRUE(read);
  EXPECT_THAT(read->unsealed, HasSubstr("its seal does not match"));
  EXPECT_EQ(ReadBaseline(Text(), "b.json")->unsealed, "");
  // One of an older version has no seal.
  std::string older = Replaced(Text(), "\"schema\":2", "\"schema\":1");
  older.erase(older.find(",\n\"seal\""));
  const auto without_seal = ReadBaseline(older + "}", "b.json");
  ASSERT_FALSE(without_seal);
  EXPECT_THAT(ToString(without_seal.error()), HasSubstr("has no seal"));
  const auto unsealed = ReadBaseline(older + "}", "b.json", BaselineSeal::kMayBreak);
  ASSERT_TRUE(unsealed) << ToString(unsealed.error());
  EXPECT_THAT(unsealed->unsealed, HasSubstr("has no seal"));
  EXPECT_THAT(ComplaintAbout(Replaced(Text(), "\"schema\":2", "\"schema\":1")), HasSubstr("has a 'seal'"));
  EXPECT_THAT(ComplaintAbout(Replaced(older + "}", "\"schema\":1", "\"schema\":2")), HasSubstr("lacks its 'seal'"));
}

TEST(Baseline, IsRefusedWhenAKeyStandsTwice) {
  const std::string text = Text();
  // Each of these a JSON library reads, keeping one of the two.
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"seed\":5", "\"seed\":5,\"seed\":5")),
              HasSubstr("b.json:3: the key 'seed' appears twice in one object, first in line 3; allowed: once"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"values\":[\n", "\"statuses\":[],\n\"values\":[\n")),
              HasSubstr("b.json:11: the key 'statuses' appears twice in one object, first in line 5"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"cells\"", "\"cells\":\"oooo\",\n\"cells\"")),
              HasSubstr("b.json:7: the key 'cells' appears twice in one object, first in line 6"));
  // Written with an escape, it is the same key.
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"seed\":5", "\"seed\":5,\"s\\u0065ed\":7")),
              HasSubstr("the key 'seed' appears twice"));
  // A text that looks like a key is none, nor is a key of another object.
  EXPECT_EQ(ComplaintAbout(Replaced(text, "\"suite\":\"example\"", "\"suite\":\"\\\"seed\\\":5,{\"")), "");
}

TEST(Baseline, IsRefusedWhenAValueIsNoneOrOfAnotherKind) {
  const std::string text = Text();
  const auto complaint = [&](const std::string& from, const std::string& to) {
    return ComplaintAbout(Replaced(text, from, to));
  };
  EXPECT_THAT(complaint("\"seed\":5", "\"seed\":null"),
              HasSubstr("b.json:3: 'seed' of a scenario is null; allowed: a whole number, 0 or more"));
  EXPECT_THAT(complaint("\"seed\":5", "\"seed\":-5"), HasSubstr("'seed' of a scenario is -5"));
  EXPECT_THAT(complaint("\"seed\":5", "\"seed\":5.5"), HasSubstr("'seed' of a scenario is 5.5"));
  for (const char* trials : {"null", "24.5", "0", "-24", "true", "\"24\"", "[24]", "18446744073709551615", "{}"}) {
    EXPECT_THAT(complaint("\"trials\":24", std::string("\"trials\":") + trials),
                HasSubstr("b.json:3: 'trials' of a scenario is "))
        << trials;
  }
  EXPECT_THAT(complaint("\"schema\":2", "\"schema\":null"), HasSubstr("b.json: 'schema' of a baseline is null"));
  EXPECT_THAT(complaint("\"suite\":\"example\"", "\"suite\":7"),
              HasSubstr("'suite' of a baseline is 7; allowed: a text"));
  EXPECT_THAT(complaint("\"position_error_cm\":1", "\"position_error_cm\":null"),
              HasSubstr("'position_error_cm' of 'metrics' of a scenario is null"));
  EXPECT_THAT(complaint("\"cells\":\"ooou", "\"cells\":null,\"x\":\"ooou"),
              HasSubstr("b.json:6: unknown key of a line of statuses 'x'"));
  const std::string ended = "\"cells\":\"ooou" + std::string(20, 'o') + "\"";
  EXPECT_THAT(complaint(ended, "\"cells\":null"),
              HasSubstr("b.json:6: 'cells' of a line of statuses is null; allowed: a text"));
  EXPECT_THAT(complaint(ended, "\"cells\":[\"o\"]"), HasSubstr("'cells' of a line of statuses is a list"));
  EXPECT_THAT(complaint("\"method\":\"a\",\"cells\"", "\"method\":null,\"cells\""),
              HasSubstr("'method' of a line of statuses is null"));
  EXPECT_THAT(complaint("\"worlds\":{", "\"worlds\":{\"x\":null,"), HasSubstr("'x' of 'worlds' of a scenario is null"));
  EXPECT_THAT(complaint("\"suite\"", "\"suites\":1,\"suite\""),
              HasSubstr("b.json: unknown key of a baseline 'suites'; did you mean 'suite'?"));
  EXPECT_THAT(complaint("\"seed\":5,", ""), HasSubstr("b.json:3: a scenario lacks 'seed'"));
  EXPECT_THAT(ComplaintAbout(R"({"schema":1,"etude":"1","suite":"x","scenarios":[],"statuses":[],"values":[]})"),
              HasSubstr("contains no scenario"));
  EXPECT_THAT(ComplaintAbout(R"({"schema":1,"etude":"1","suite":"x","scenarios":{},"statuses":[],"values":[]})"),
              HasSubstr("'scenarios' of a baseline is an empty object; allowed: a list"));
}

TEST(Baseline, IsRefusedWhenItHoldsMoreNullsThanItTells) {
  const std::string text = Text();
  EXPECT_THAT(text, HasSubstr("\"nulls\":1,\"values\":[10.0,11.0,12.0,null,"));
  EXPECT_THAT(
      ComplaintAbout(Replaced(text, "[10.0,", "[null,")),
      HasSubstr("b.json:12: 2 of the values of position_error_cm of s, joint_noise_deg=1, a are null, the first "
                "in trial 0; allowed: as many as the line's 'nulls' says, 1"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "12.0,null,", "12.0,13.0,")), HasSubstr("0 of the values"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"nulls\":1,", "")), HasSubstr("'nulls' says, 0"));
  EXPECT_THAT(ComplaintAbout(Replaced(text, "\"nulls\":1", "\"nulls\":0")), HasSubstr("a whole number, 1…24"));
}

TEST(Baseline, IsRefusedWhenAMethodFailedEverywhereButNotWhenItWasSkippedOrUnsolved) {
  const std::string text = Text();
  const std::string ended = "\"method\":\"a\",\"cells\":\"ooou" + std::string(20, 'o');
  const auto complaint = [&](const std::string& letters) {
    return ComplaintAbout(Replaced(text, ended, "\"method\":\"a\",\"cells\":\"" + letters));
  };
  EXPECT_THAT(complaint(std::string(24, 'f')),
              HasSubstr("b.json:6: all 24 cells of s, joint_noise_deg=1, a failed: nothing could be worse"));
  EXPECT_THAT(complaint(std::string(12, 'f') + std::string(12, 'b')), HasSubstr("all 24 cells"));
  EXPECT_EQ(complaint(std::string(23, 'f') + "o"), "");
  EXPECT_EQ(complaint(std::string(24, 'u')), "");
  EXPECT_EQ(complaint(std::string(24, 's')), "");
  std::string skipped = text;
  for (int i = 0; i < 4; ++i) skipped = Replaced(skipped, "ooou" + std::string(20, 'o'), std::string(24, 's'));
  EXPECT_THAT(ComplaintAbout(skipped), HasSubstr("no cell is ok or unsolved"));
  // Which is no letter of a baseline: none is made where the machine ended a cell.
  EXPECT_THAT(complaint("t" + std::string(23, 'o')), HasSubstr("are not 24 letters of 'oufbs'"));
}

/// The file with one character gone, doubled or replaced: whatever comes of it, it is refused or read, never thrown.
TEST(Baseline, ThatWasTornAnywhereIsRefusedInOneLineOrReadsAsAnotherOne) {
  const std::string text = Text();
  int refused = 0, tried = 0;
  for (std::size_t at = 0; at < text.size(); at += 3) {
    for (const std::string& put :
         {std::string(), std::string(2, text[at]), std::string("\""), std::string("7"), std::string("}")}) {
      const std::string complaint = ComplaintAbout(std::string(text).replace(at, 1, put));
      ++tried;
      refused += !complaint.empty();
      EXPECT_EQ(complaint.find('\n'), std::string::npos);
      EXPECT_TRUE(complaint.empty() || complaint.rfind("b.json", 0) == 0) << complaint;
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
  EXPECT_THAT(ComplaintAbout(text), HasSubstr("4 lines of statuses and 7 of values, but its scenarios have 4 and 8"));
}

}  // namespace
}  // namespace etude
