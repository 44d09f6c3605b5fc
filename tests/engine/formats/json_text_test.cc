#include "engine/formats/json_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace etude {
namespace {

using namespace std::string_view_literals;

std::string JsonComplaint(std::string_view text) {
  const auto json = ParseJsonText(text, "f");
  return json ? "" : ToString(json.error());
}

TEST(JsonText, IsReadAsItStands) {
  EXPECT_EQ(ParseJsonText(R"({"a": [1, 2.5, null]})", "f").value(), (nlohmann::json{{"a", {1, 2.5, nullptr}}}));
}

TEST(JsonText, SaysWhereItEndsToBeAny) {
  EXPECT_EQ(JsonComplaint("[1,\n 2, x]"), "f:2:5: from this place on, the text is not valid JSON");
  EXPECT_EQ(JsonComplaint("[1"), "f:1:3: from this place on, the text is not valid JSON");
  EXPECT_EQ(JsonComplaint(""), "f:1:1: from this place on, the text is not valid JSON");
}

TEST(JsonText, DoesNotEndAtAZeroByte) {
  EXPECT_EQ(JsonComplaint("[1]\n\0, 2]"sv), "f:2:1: found a zero byte; allowed: JSON text without zero bytes");
}

TEST(JsonText, RefusesNumbersThatNoDoubleHolds) { EXPECT_NE(JsonComplaint("[1e999]"), ""); }

}  // namespace
}  // namespace etude
