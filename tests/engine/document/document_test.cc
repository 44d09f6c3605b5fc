#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/document/fields.h"
#include "engine/document/node.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

std::string Complaint(const std::string& yaml) {
  const auto node = ParseYaml(yaml, "t.yaml");
  if (!node) return ToString(node.error());
  Fields fields(*node, "a test");
  fields.Number("speed", 1, {0, 10});
  fields.Integer("count", 3, {1, 5});
  fields.Choice("solver", {"ccd", "dls"}, "ccd");
  fields.Boolean("on", false);
  fields.Texts("names");
  return testing::Refusal(fields.Finish());
}

TEST(Document, KnowsTheLineAndColumnOfEveryValue) {
  ASSERT_OK(node, ParseYaml("a: 1\nb:\n  - x\n  - {c: 2}\n", "t.yaml"));
  const Node& inner = node->Find("b")->items[1];
  EXPECT_EQ(ToString(inner.Find("c")->place), "t.yaml:4:9");
  EXPECT_EQ(ToString(node->Find("b")->items[0].place), "t.yaml:3:5");
}

TEST(Document, TakesLineEndsOfUnixAndWindowsAndNoOthers) {
  EXPECT_EQ(Complaint("speed: 2.5\r\ncount: 5\r\n"), "accepted");
  const std::string told = "found a carriage return without a line feed; allowed: lines that end in \\n or \\r\\n";
  EXPECT_EQ(Complaint("speed: 2.5\rcount: 5\n"), "t.yaml:1:11: " + told);
  EXPECT_EQ(Complaint("speed: 2.5\ncount: 5 # few\r"), "t.yaml:2:15: " + told);
  EXPECT_EQ(Complaint("speed: 2.5\r\r\n"), "t.yaml:1:11: " + told);
}

TEST(Document, AsksWhetherANearbyKeyWasMeantToBeTheMissingOne) {
  const auto complaint = [](const std::string& yaml) {
    const auto node = ParseYaml(yaml, "t.yaml");
    Fields fields(*node, "a test");
    fields.RequiredText("question");
    return ToString(fields.Finish().error());
  };
  EXPECT_EQ(complaint("a: 1\nQestion: q\n"), "t.yaml:2:1: a test needs 'question'; is 'Qestion' a misspelling of it?");
  EXPECT_EQ(complaint("a: 1\n"), "t.yaml:1:1: a test needs 'question'");
  EXPECT_EQ(complaint("a: 1\nquestion:\n"), "t.yaml:2:1: 'question' must be text, found nothing");
  EXPECT_EQ(complaint("question: ''\n"), "t.yaml:1:11: a test needs 'question'");
}

TEST(Document, NamesEveryAllowedKeyOnce) {
  const auto node = ParseYaml("zz: 1\n", "t.yaml");
  Fields fields(*node, "a test");
  fields.Raw("a");
  fields.Number("a", 1);
  EXPECT_EQ(ToString(fields.Finish().error()), "t.yaml:1:1: unknown key of a test 'zz'. Allowed: a");
}

TEST(Document, RefusesInfinitiesAndNotANumber) {
  for (const char* text : {"speed: inf", "speed: nan", "speed: .inf", "speed: .nan", "speed: 1e999"}) {
    EXPECT_THAT(Complaint(text), HasSubstr("expected a number")) << text;
  }
}

TEST(Document, RefusesControlCharactersThatATerminalWouldObey) {
  EXPECT_THAT(Complaint("a: 1\nb: \"\\e[31m\"\n"), HasSubstr("t.yaml:2:4: found the control character U+001B"));
  EXPECT_THAT(Complaint("\"a\\x9b\": 1\n"), HasSubstr("t.yaml:1:1: found the control character U+009B"));
  EXPECT_THAT(Complaint("a: [\"\\x7f\"]\n"), HasSubstr("found the control character U+007F"));
  EXPECT_TRUE(ParseYaml("a: \"one\\n\\ttwo \\xe9\"\n", "t.yaml"));
}

TEST(Document, RefusesBrokenOrHostileText) {
  EXPECT_THAT(Complaint("a: [1, 2\n"), HasSubstr("not valid YAML"));
  EXPECT_THAT(Complaint("speed: 1\nspeed: 2\n"), HasSubstr("t.yaml:2:1: the key 'speed' appears twice here"));
  EXPECT_THAT(Complaint("a: &x 1\nb: *x\n"), HasSubstr("t.yaml:2:4: aliases (*name) are not supported"));
  EXPECT_THAT(Complaint(std::string(200000, '[')), HasSubstr("nested more than 32 levels deep"));
  EXPECT_THAT(Complaint(std::string(200000, '{')), HasSubstr("nested more than 32 levels deep"));
  for (const char* marker : {"- ", "? "}) {
    std::string markers;
    for (int i = 0; i < 50000; ++i) markers += marker;
    EXPECT_THAT(Complaint(markers), HasSubstr("nested more than 32 levels deep"));
  }
  EXPECT_THAT(Complaint(std::string(2 << 20, 'x')), HasSubstr("allowed: at most 1048576"));
}

TEST(Document, ReadsThirtyTwoLevelsAndNotOneMore) {
  const auto keys = [](int levels) {
    std::string text;
    for (int i = 0; i < levels; ++i) text += std::string(i, ' ') + "a:\n";
    return text;
  };
  const auto markers = [](int levels) {
    std::string text;
    for (int i = 0; i < levels; ++i) text += "- ";
    return text + "x\n";
  };
  // A closed level does not count.
  const auto closed = [](int levels) {
    std::string text;
    for (int i = 0; i < levels; ++i) text += "- [{a: 1}]\n";
    return text;
  };
  const auto complaint = [](const std::string& yaml) { return testing::Message(ParseYaml(yaml, "t.yaml")); };
  EXPECT_EQ(complaint(keys(32)), "accepted");
  EXPECT_EQ(complaint(keys(33)), "nested more than 32 levels deep");
  EXPECT_EQ(complaint(markers(32)), "accepted");
  EXPECT_EQ(complaint(markers(33)), "nested more than 32 levels deep");
  EXPECT_EQ(complaint(closed(100)), "accepted");
}

TEST(Document, TakesWhatIsNotThereAsItIs) {
  const auto node = ParseYaml("{name: x, count: 3}", "t.yaml");
  Fields fields(*node, "a test");
  EXPECT_EQ(fields.Text("name", "none"), "x");
  EXPECT_EQ(fields.Text("title", "none"), "none");
  EXPECT_EQ(fields.Integer("count", 7, {1, 5}), 3);
  EXPECT_EQ(fields.Integer("turns", 7, {1, 9}), 7);
  EXPECT_TRUE(fields.Finish());
}

TEST(Document, SurvivesEveryTruncationAndManyMutations) {
  const std::string good = "scenario: ik\ntrials: 5\nsweep: {a: [1, 2]}\nmethods:\n  - {name: x, solver: 'c\"d'}\n";
  for (std::size_t length = 0; length <= good.size(); ++length) ParseYaml(good.substr(0, length), "t.yaml");
  int refused = 0;
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (char c : {'\0', '*', '&', '{', ']', ':', '\n', '\t', '\xff', '%', '!', '|'}) {
      std::string bad = good;
      bad[at] = c;
      if (!ParseYaml(bad, "t.yaml")) ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

TEST(Document, RefusesASecondDocumentAndMoreValuesThanItLoadsQuickly) {
  EXPECT_THAT(Complaint("speed: 1\n---\nspeed: 2\n"), HasSubstr("more than one YAML document"));
  EXPECT_THAT(Complaint("---\nspeed: 1\n---\n# and\nspeed: 2\n"), HasSubstr("more than one YAML document"));
  EXPECT_THAT(Complaint("# a test\n\n speed: 1\n\nturns: 2\n"),
              HasSubstr(":5: is indented less than the first line, which is line 3; allowed: the same indentation"));
  std::string many;
  for (int i = 0; i < 6000; ++i) many += fmt::format("a{}: 1\n", i);
  EXPECT_THAT(Complaint(many), HasSubstr("allowed: at most 10000"));
}

}  // namespace
}  // namespace etude
