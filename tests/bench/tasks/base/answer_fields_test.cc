#include "bench/tasks/base/answer_fields.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace etude {
namespace {

TEST(AnswerFields, ReadsWhatIsThere) {
  const Json json = {{"frame", 7}, {"none", nullptr}, {"score", 0.5}, {"name", "cut"}, {"list", {1, 2}}, {"yes", true}};
  AnswerFields fields(json);
  EXPECT_EQ(fields.Integer("frame", 0, 9), 7);
  EXPECT_EQ(fields.NullableInteger("none", 0, 9), std::nullopt);
  EXPECT_EQ(fields.Number("score", {0, 1}), 0.5);
  EXPECT_EQ(fields.Choice("name", {"cut", "glue"}, "glue"), "cut");
  EXPECT_EQ(fields.Choice("absent", {"cut", "glue"}, "glue"), "glue");
  EXPECT_EQ(fields.List("list", 2, 2).size(), 2u);
  EXPECT_TRUE(fields.List("absent_list", 0, 9).empty());
  EXPECT_TRUE(fields.Boolean("yes", false));
  EXPECT_TRUE(fields.Finish());
}

TEST(AnswerFields, KeepsTheFirstComplaintAndGoesOnWithDefaults) {
  const Json json = {{"a", 11}, {"b", "x"}};
  AnswerFields fields(json, "events[2]");
  EXPECT_EQ(fields.Integer("a", 0, 10), 0);
  EXPECT_EQ(fields.Integer("b", 3, 10), 3);
  EXPECT_EQ(fields.Finish().error().message, "events[2].a: 11; allowed: 0…10");
}

TEST(AnswerFields, RefusesNumbersThatAreTooLargeForAnInt) {
  for (const char* text : {"{\"a\": 18446744073709551615}", "{\"a\": -9223372036854775808}", "{\"a\": 4294967296}"}) {
    const Json json = Json::parse(text);
    AnswerFields fields(json);
    EXPECT_EQ(fields.Integer("a", 0, 10), 0);
    EXPECT_FALSE(fields.Finish()) << text;
  }
}

TEST(AnswerFields, TakesAWholeNumberHoweverItIsWritten) {
  const Json json = Json::parse(R"({"a": 3, "b": 3.0, "c": 0.3e1})");
  AnswerFields fields(json);
  for (const char* key : {"a", "b", "c"}) EXPECT_EQ(fields.Integer(key, 0, 10), 3);
  EXPECT_TRUE(fields.Finish());
  for (const char* text : {"{\"a\": 3.5}", "{\"a\": \"3\"}", "{\"a\": true}", "{\"a\": null}", "{\"a\": 1e300}"}) {
    const Json other = Json::parse(text);
    AnswerFields refusing(other);
    EXPECT_EQ(refusing.Integer("a", 1, 10), 1);
    EXPECT_FALSE(refusing.Finish()) << text;
  }
}

TEST(AnswerFields, RefusesAKeyThatNobodyAskedFor) {
  const Json json = {{"frame", 1}, {"fame", 2}};
  AnswerFields fields(json);
  fields.Integer("frame", 0, 10);
  EXPECT_EQ(fields.Finish().error().message, "the answer: unknown key 'fame'; did you mean 'frame'? Allowed: frame");
}

TEST(AnswerFields, ShortensWhatItShows) {
  EXPECT_EQ(ShowJson(Json(std::string(1000, 'x'))).size(), 40 + std::string("…").size());
  EXPECT_EQ(ShowJson(Json("\xff")), R"("\ufffd")");
}

}  // namespace
}  // namespace etude
