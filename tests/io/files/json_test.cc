#include "io/files/json.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

TEST(Json, IsWrittenInTheOrderGivenAndReadsBackTheSame) {
  const Json json{{"b", 0.1}, {"a", {1, nullptr, "\u00e9"}}};
  ASSERT_OK(text, WriteJson(json));
  EXPECT_EQ(*text, "{\"b\":0.1,\"a\":[1,null,\"\u00e9\"]}");
  EXPECT_EQ(*ReadJson(*text, "x"), json);
}

TEST(Json, RefusesWhatIsNotAFiniteNumberAndNamesItsPath) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    EXPECT_EQ(testing::Refusal(WriteJson({{"cells", {1.0, {{"error", bad}}}}})),
              "/cells/1/error is not a finite number");
  }
}

TEST(Json, WritesWhatNobodySeesByItsNumber) {
  const Json json = {{"a\u202eb", "größe \u2066\U000E0041 𝄞"}};
  const std::string text = *WriteJson(json);
  EXPECT_EQ(text, R"({"a\u202eb":"größe \u2066\udb40\udc41 𝄞"})");
  EXPECT_EQ(*ReadJson(text, "f"), json);
}

TEST(Json, CountsOnlyBracketsOutsideOfTexts) {
  EXPECT_EQ(NestingOf("1"), 0);
  EXPECT_EQ(NestingOf(R"([{"a": "[[[\"[["}])"), 2);
  EXPECT_EQ(NestingOf("[[["), 3);
}

TEST(Json, DoesNotEndAtAZeroByte) {
  using namespace std::string_literals;
  EXPECT_TRUE(ReadJson("5 \n", "f"));
  EXPECT_FALSE(ReadJson("5\0"s, "f"));
  EXPECT_FALSE(ReadJson("5\0garbage"s, "f"));
}

TEST(Json, RefusesDeepNestingBeforeItTakesTheStack) {
  const std::string deep(1'000'000, '[');
  EXPECT_THAT(ToString(ReadJson(deep, "a.json", 7).error()), HasSubstr("a.json:7: nested more than 100 levels deep"));
  EXPECT_TRUE(ReadJson(std::string(100, '[') + std::string(100, ']'), "a.json"));
  EXPECT_FALSE(ReadJson(std::string(101, '[') + std::string(101, ']'), "a.json"));
}

std::string Cbor(const Json& json) {
  const std::vector<std::uint8_t> bytes = Json::to_cbor(json);
  return {bytes.begin(), bytes.end()};
}

TEST(Cbor, ReadsBackTheSame) {
  const Json json{{"a", {1, -2, 0.5, nullptr, true, std::string(300, 'x')}}, {"b", Json::binary({0, 0xff})}, {"c", {}}};
  EXPECT_EQ(*ReadCbor(Cbor(json), "x"), json);
  EXPECT_THAT(ToString(ReadCbor(Cbor(json).substr(0, 20), "a.pack").error()), HasSubstr("a.pack: not valid CBOR: "));
}

TEST(Cbor, RefusesDeepNestingBeforeItTakesTheStack) {
  for (const char list : {'\x81', '\xa1', '\x9f', '\x7f', '\x5f', '\xc1'}) {
    EXPECT_THAT(ToString(ReadCbor(std::string(1'000'000, list), "a.pack").error()),
                HasSubstr("not CBOR as Etude writes it"));
  }
  EXPECT_TRUE(ReadCbor(std::string(99, '\x81') + "\x80", "x"));
  EXPECT_FALSE(ReadCbor(std::string(100, '\x81') + "\x80", "x"));
  EXPECT_FALSE(ReadCbor(std::string("\x9b\xff\xff\xff\xff\xff\xff\xff\xff", 9), "x"));
}

}  // namespace
}  // namespace etude
