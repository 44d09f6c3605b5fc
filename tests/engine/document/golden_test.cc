#include <gtest/gtest.h>

#include <cmath>

#include "engine/document/fields.h"
#include "engine/document/node.h"
#include "tests/engine/formats/spoilt.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

void AddNode(testing::Fingerprint& print, const Node& node) {
  print.Add(node.kind).Add(node.scalar).Add(node.place.line).Add(node.place.column).Add(Describe(node));
  print.Add(CountValues(node)).Add(node.items.size()).Add(node.entries.size());
  for (const Node& item : node.items) AddNode(print, item);
  for (const Node::Entry& entry : node.entries) {
    print.Add(entry.key).Add(entry.place.line).Add(entry.place.column);
    AddNode(print, entry.value);
  }
}

/// Reads every kind of key, and adds what it was or what is complained of.
void AddFields(testing::Fingerprint& print, const Node& node) {
  Fields fields(node, "a test");
  print.Add(fields.Number("speed", 1.25, {0, 10})).Add(fields.Integer("count", 3, {1, 5}));
  print.Add(fields.Boolean("on", true)).Add(fields.Text("text", "none"));
  print.Add(fields.Choice("solver", {"ccd", "dls"}, "ccd")).Add(fields.Texts("names"));
  print.Add(fields.Numbers("sizes", {-1, 1})).Add(fields.OptionalNumber("maybe", {0, 2}));
  print.Add(fields.Number("most", 1, {.highest = 3})).Add(fields.Number("least", 5, {.lowest = 2}));
  print.Add(fields.OptionalWhole("seed", {0, 1e12})).Add(fields.RequiredText("title")).Add(fields.ok());
  print.Add(fields.Raw("more") != nullptr);
  const Result<void> done = fields.Finish();
  print.Add(done.has_value());
  if (!done) print.Add(ToString(done.error()));
}

TEST(DocumentGolden, OfSpoiltDocuments) {
  const std::string text =
      "# a test\nspeed: 2.5\ncount: 5\non: false\ntext: \"a: b\"\nsolver: dls\nnames: [a, 'b c', d]\nsizes:\n  - 0.5\n "
      " - -1\n"
      "maybe: 2\nseed: 123456789012\ntitle: >\n  folded\n  lines\nmore: {x: [1, {y: ~}], z: ''}\n";
  testing::Fingerprint print;
  const auto add = [&](const std::string& yaml) {
    testing::Fingerprint one;
    const auto node = ParseYaml(yaml, "t.yaml");
    if (!node) one.Add(ToString(node.error()));
    if (node) AddNode(one, *node);
    if (node) AddFields(one, *node);
    print.Add(std::asinh(one.sum()));
  };
  add(text);
  for (const std::string& spoilt : testing::SpoiltTexts(text, 1, 900)) add(spoilt);
  for (const char* line : {"speed: 0",    "speed: 10",       "speed: 10.01",      "speed: -0.1",  "count: 1",
                           "count: 0",    "count: 6",        "count: 2147483648", "seed: 1e12",   "seed: 1000000000001",
                           "seed: 1.5",   "most: 3",         "most: 3.1",         "least: 2",     "least: 1.9",
                           "maybe: 2.1",  "sizes: [1, 1.1]", "sizes: 3",          "names: [[a]]", "solver: cdc",
                           "soler: ccd",  "titel: x",        "on: yes",           "speed: 0x10",  "speed: 1_0",
                           "speed: ' 1'", "speed: .5",       "speed: +1",         "speed: 1e400", "a: &x 1\nb: *x",
                           "--- 1\n--- 2"}) {
    add(std::string("title: t\n") + line + "\n");
    add(std::string(line) + "\n");
  }
  EXPECT_TRUE(print.Is(963, 41.5607157477));
}

TEST(DocumentGolden, OfLimits) {
  const auto nested = [](int levels) { return std::string(levels, '[') + "1" + std::string(levels, ']'); };
  const auto wide = [](int values) {
    std::string text = "[";
    for (int i = 0; i < values; ++i) text += "1,";
    return text + "]";
  };
  std::vector<bool> read;
  for (const int levels : {31, 32, 33}) read.push_back(ParseYaml(nested(levels), "t.yaml").has_value());
  for (const int values : {9998, 9999, 10000, 10001}) read.push_back(ParseYaml(wide(values), "t.yaml").has_value());
  for (const int bytes : {99, 100, 101}) {
    read.push_back(ParseYaml(std::string(bytes - 1, ' ') + "1", "t.yaml", 100).has_value());
  }
  testing::Fingerprint print;
  for (const bool is_read : read) print.Add(is_read);
  EXPECT_TRUE(print.Is(10, 0.0321463476866));
}

}  // namespace
}  // namespace etude
