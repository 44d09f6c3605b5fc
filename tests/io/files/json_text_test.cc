#include "io/files/json_text.h"

#include <gtest/gtest.h>
#include <time.h>

#include <string>

namespace etude {
namespace {

double CpuSeconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TEST(JsonText, ReadsWhatNlohmannsParserReads) {
  for (const char* text :
       {"null", "true", "-1", "18446744073709551615", "0.1", "1e3", "\"\\u00e9\"", "[]", "{}", "[[],[{}],{\"a\":[1]}]",
        R"({"z":1,"a":{"z":[1,2.5,"x",null,false],"b":{}},"m":[]})", " [1 , 2] "}) {
    const JsonText read = ParseJsonText(text);
    EXPECT_FALSE(read.fault) << text;
    EXPECT_FALSE(read.repeated_key) << text;
    EXPECT_EQ(read.value, Json::parse(text)) << text;
    EXPECT_EQ(read.value.dump(), Json::parse(text).dump()) << "in the same order";
  }
}

TEST(JsonText, NamesTheFirstKeyThatStandsTwiceInOneObject) {
  EXPECT_EQ(ParseJsonText(R"({"a":{"b":1},"c":{"b":2}})").repeated_key, std::nullopt);
  EXPECT_EQ(ParseJsonText(R"({"a":{"b":1,"x":[],"b":2},"a":3})").repeated_key, "b");
  EXPECT_EQ(ParseJsonText(R"([{"a":1},{"a":1,"a":1}])").repeated_key, "a");
  EXPECT_EQ(ParseJsonText(R"({"a":1,"\u0061":1})").repeated_key, "a");
}

TEST(JsonText, TellsWhereATextIsNoJson) {
  for (const char* text : {"", "{", "[1,]", "nul", "{\"a\"}", "1 2", "\"\xff\"", "{\"a\":1}}"}) {
    ASSERT_TRUE(ParseJsonText(text).fault) << text;
    EXPECT_FALSE(ParseJsonText(text).fault->is_large_number) << text;
    try {
      std::ignore = Json::parse(text);
      ADD_FAILURE() << text;
    } catch (const Json::parse_error& error) {
      EXPECT_EQ(ParseJsonText(text).fault->byte, error.byte) << text;
    }
  }
  ASSERT_TRUE(ParseJsonText("[1e999]").fault);
  EXPECT_TRUE(ParseJsonText("[1e999]").fault->is_large_number);
}

// nlohmann's parser with a callback takes 20 s for the first text, its ordered objects as long for the second.
TEST(JsonText, TakesTimeInProportionToTheLength) {
  std::string objects = "[{}", keys = "{\"a\":1";
  for (int i = 0; i < 150'000; ++i) objects += ",{}";
  for (int i = 0; i < 50'000; ++i) keys += ",\"" + std::to_string(i) + "\":1";
  const double before = CpuSeconds();
  EXPECT_EQ(ParseJsonText(objects + "]").value.size(), 150'001u);
  EXPECT_EQ(ParseJsonText(keys + "}").value.size(), 50'001u);
  EXPECT_LT(CpuSeconds() - before, 8);
}

}  // namespace
}  // namespace etude
