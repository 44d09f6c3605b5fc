#include <gtest/gtest.h>

#include "engine/document/fields.h"
#include "engine/document/node.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/support/kept_lines.h"

namespace etude {
namespace {

Result<void> ReadEveryKind(const std::string& text) {
  const Result<Node> node = ParseYaml(text, "t.yaml");
  if (!node) return tl::unexpected(node.error());
  Fields fields(*node, "a test");
  fields.Number("speed", 1.25, {0, 10});
  fields.Integer("count", 3, {1, 5});
  fields.Boolean("on", true);
  fields.Text("text", "none");
  fields.Choice("solver", {"ccd", "dls"}, "ccd");
  fields.Texts("names");
  fields.Numbers("sizes", {-1, 1});
  fields.OptionalNumber("maybe", {0, 2});
  fields.Number("most", 1, {.highest = 3});
  fields.Number("least", 5, {.lowest = 2});
  fields.OptionalWhole("seed", {0, 1e12});
  fields.RequiredText("title");
  fields.Raw("more");
  return fields.Finish();
}

TEST(Document, ComplaintsAboutSpoiltFieldsAreAsTheyWere) {
  const std::string text =
      "# a test\nspeed: 2.5\ncount: 5\non: false\ntext: \"a: b\"\nsolver: dls\nnames: [a, 'b c', d]\nsizes:\n  - 0.5\n "
      " - -1\nmaybe: 2\nseed: 123456789012\ntitle: >\n  folded\n  lines\nmore: {x: [1, {y: ~}], z: ''}\n";
  testing::ComplaintLines complaints;
  complaints.Add("spoilt", testing::SpoiltTexts(text, 1, 900), ReadEveryKind);
  for (const std::string line : {"speed: 0",
                                 "speed: 10",
                                 "speed: 10.01",
                                 "speed: -0.1",
                                 "count: 1",
                                 "count: 0",
                                 "count: 6",
                                 "count: 2147483648",
                                 "seed: 1e12",
                                 "seed: 1000000000001",
                                 "seed: 1.5",
                                 "most: 3",
                                 "most: 3.1",
                                 "least: 2",
                                 "least: 1.9",
                                 "maybe: 2.1",
                                 "sizes: [1, 1.1]",
                                 "sizes: 3",
                                 "names: [[a]]",
                                 "solver: cdc",
                                 "soler: ccd",
                                 "titel: x",
                                 "on: yes",
                                 "speed: 0x10",
                                 "speed: 1_0",
                                 "count: 2.5",
                                 "speed: [1]",
                                 "names: a",
                                 "speed: ' 1'",
                                 "speed: .5",
                                 "speed: +1",
                                 "speed: 1e400",
                                 "b: *x"}) {
    complaints.Add(line, std::vector{"title: t\n" + line + "\n"}, ReadEveryKind);
  }
  EXPECT_TRUE(testing::AreKept(complaints.lines(), "tests/engine/document/complaints.txt"));
}

TEST(Document, IsReadUpToItsLimits) {
  const auto nested = [](int levels) { return std::string(levels, '[') + "1" + std::string(levels, ']'); };
  const auto wide = [](int values) {
    std::string text = "[";
    for (int i = 0; i < values; ++i) text += "1,";
    return text + "]";
  };
  for (const int levels : {31, 32, 33}) EXPECT_EQ(ParseYaml(nested(levels), "t.yaml").has_value(), levels < 33);
  for (const int values : {9998, 9999, 10000}) EXPECT_EQ(ParseYaml(wide(values), "t.yaml").has_value(), values < 10000);
  for (const int bytes : {99, 100, 101}) {
    EXPECT_EQ(ParseYaml(std::string(bytes - 1, ' ') + "1", "t.yaml", 100).has_value(), bytes < 101);
  }
}

}  // namespace
}  // namespace etude
